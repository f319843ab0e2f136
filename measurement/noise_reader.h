// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "config/strict_yaml.h"
#include "config/units.h"
#include "measurement/dataset.h"

namespace hexcal {

// One number above zero, as it stands in the file.
double ReadSigma(const YamlNode& node, std::string_view what);
// A number for all axes, or three, each above zero.
Eigen::Vector3d ReadSigmas(const YamlNode& node, std::string_view what);
// {position: .., orientation: ..}, each a number or three along the axes of the pose's own frame.
PoseNoise ReadPoseNoise(const YamlNode& node, const Units& units);

}  // namespace hexcal
