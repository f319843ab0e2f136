// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// The files of apps/init/, embedded when hexcal was built: two datasets to start from, of markers
// and of poses, with their tables; simulated.
std::string_view InitMarkersYaml();
std::string_view InitPosesYaml();
std::string_view InitRobotTable();
std::string_view InitMarkersTable();
std::string_view InitMeasuredTable();

}  // namespace hexcal
