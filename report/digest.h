// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// SHA-256 in 64 hexadecimal digits.
std::string Sha256(std::string_view bytes);

// A file and what it held when it was read.
struct HashedFile {
  std::string path;
  std::string sha256;
};

// InputError for a file that cannot be read.
std::vector<HashedFile> HashFiles(const std::vector<std::string>& paths);

}  // namespace hexcal
