// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// hexcal export FORMAT RESULT.json: a calibration for other programs. files: these two.
int RunExport(const std::vector<std::string>& files);

// What help says of the command, the formats by their table.
std::string_view ExportDescription();

}  // namespace hexcal
