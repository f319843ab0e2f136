// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "config/strict_yaml.h"
#include "geometry/pose.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// easy_handeye's calibration file: parameters (eye_on_hand, names of frames) and transformation
// {x, y, z, qx, qy, qz, qw}, m: the tracker in the effector for eye_on_hand, else in the robot's
// base. Other keys are not looked at.
StoredTransform ReadEasyHandeye(const std::string& path);

// industrial_calibration's list of poses: data: [{pose: FILE.yaml, ...}, ...], each file with x, y,
// z, qx, qy, qz, qw, m. Files are found from the list's folder and may not lie outside of it. Rows
// are labelled by the names of their files.
Recording ReadIndustrialCalibration(const std::string& path, const ImportOptions& options);

// {x, y, z, qx, qy, qz, qw}, m, as ROS programs write it. Other keys are not looked at.
Pose3d ReadRosPose(const YamlNode& node);

}  // namespace hexcal
