// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "config/strict_yaml.h"

namespace hexcal {

// A list of files and of patterns with * ? [...] for files, from the folder of the manifest. In the
// list's order, what a pattern matches by name. InputError for a pattern that matches nothing, and
// for a file that is there twice.
std::vector<std::string> ReadFileList(const std::string& manifest_path, const YamlNode& list);

// A path that stands in the manifest, from the folder in which hexcal runs.
std::string FromManifest(const std::string& manifest_path, const std::string& path);

}  // namespace hexcal
