// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measurement/importers/recording.h"

namespace hexcal {

// A format of other programs' files: reading, help and docs/formats.md go by this table.
struct ImportFormat {
  std::string_view name;                          // on the command line
  std::string_view summary;                       // what it is, one line
  bool is_robot;                                  // the poses of a robot, and nothing else
  bool (*recognise)(std::string_view beginning);  // by the file's first bytes
  // What it holds; the others are null.
  Recording (*read_recording)(const std::string& path, const ImportOptions& options) = nullptr;
  StatedShape (*read_shape)(const std::string& path) = nullptr;
  StoredTransform (*read_transform)(const std::string& path) = nullptr;
};

const std::vector<ImportFormat>& ImportFormats();
const ImportFormat* FindImportFormat(std::string_view name);  // nullptr if there is none

// The format that a file begins like, or nullptr. InputError where the file cannot be read.
const ImportFormat* RecogniseFormat(const std::string& path);

// Reads a file that is said to be of this format. Where it cannot be read as such and begins like
// one of another format, the InputError says so.
Recording ReadRecording(const ImportFormat& format,
                        const std::string& path,
                        const ImportOptions& options);

// A body in any of the formats of bodies, which its beginning tells.
StatedShape ReadStatedShape(const std::string& path);

}  // namespace hexcal
