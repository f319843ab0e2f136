// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "config/strict_yaml.h"
#include "model/pose_map.h"

namespace hexcal {

// {degree, reference: pose, box: {centre: [6], half_width: [6]}, coefficients: six lists}, in m and
// rad, back and forth to the last bit. InputError for what is no such map.
PoseMap ReadPoseMap(const YamlNode& node);
// The mapping's lines, each after indent.
std::string WritePoseMap(const PoseMap& map, const std::string& indent);

}  // namespace hexcal
