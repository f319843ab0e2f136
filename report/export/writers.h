// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/export/formats.h"

namespace hexcal {

// The functions of the table in formats.cc, one file each.

// Launch files of ROS 1 and ROS 2 in which tf2_ros publishes both transforms.
ExportedFiles WriteRos1(const ExportInput& input);
ExportedFiles WriteRos2(const ExportInput& input);
// Two fixed joints whose origin has xyz (m) and rpy (rad, about fixed axes).
ExportedFiles WriteUrdf(const ExportInput& input);
// The base as easy_handeye's eye on base (robot base from tracker, where world is the tracker), the
// tool as its eye on hand; the covariance beside it, where easy_handeye does not look.
ExportedFiles WriteEasyHandeye(const ExportInput& input);
// geometry_msgs/PoseWithCovarianceStamped; InputError where a covariance is not determined.
ExportedFiles WritePoseWithCovariance(const ExportInput& input);
// measured.tum and predicted.tum; the times are the numbers of the poses, from 0.
ExportedFiles WriteTum(const ExportInput& input);
// residuals.csv.
ExportedFiles WriteResiduals(const ExportInput& input);

// Covariance of (x, y, z, rotation about the parent's x, y, z), as ROS has it, of that of a small
// right motion: both turned into the parent's axes.
Matrix6d CovarianceInParent(const CalibratedMount& mount);

// Rz(yaw) Ry(pitch) Rx(roll), turns about fixed axes: roll, pitch, yaw, rad.
Eigen::Vector3d FixedAxisAngles(const Eigen::Quaterniond& rotation);

}  // namespace hexcal
