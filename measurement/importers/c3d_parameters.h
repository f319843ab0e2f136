// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/input_error.h"

namespace hexcal {

inline constexpr std::size_t kC3dBlock = 512;  // bytes

// A parameter of a C3D file, its data as they stand in it.
struct C3dParameter {
  int type = 0;  // -1 characters, 1 bytes, 2 whole numbers of 16 bits, 4 floats
  std::vector<std::size_t> dimensions;
  std::string_view data;
};

// By "GROUP:NAME" in capitals.
using C3dParameters = std::map<std::string, C3dParameter>;

// The parameter section that begins with the block of this number (from 1). The parameters refer to
// bytes. InputError where it leaves the file or is not Intel's.
C3dParameters ReadC3dParameters(std::string_view bytes, std::size_t block, const Location& file);

// The texts of a list of labels, blanks at their ends cut off.
std::vector<std::string> C3dTexts(const C3dParameter& parameter);

// The first number of a parameter as a count, without a sign; nothing where it is none.
std::optional<std::size_t> C3dCount(const C3dParameter& parameter);

[[noreturn]] void RefuseC3d(const Location& file,
                            std::size_t byte,
                            std::string_view found,
                            std::string_view expected);

}  // namespace hexcal
