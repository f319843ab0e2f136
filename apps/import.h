// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hexcal {

// hexcal import FORMAT FILES: other programs' files to a dataset. files: the format and the files.
int RunImport(const std::vector<std::string>& files);

// What help says of the command, the formats by their table.
std::string_view ImportDescription();

}  // namespace hexcal
