// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"
#include "model/corrections.h"

namespace hexcal {

// What the tracker reads of a point that is at p in its frame, m.
Eigen::Vector3d TrackerReading(const Corrections<double>& corrections, const Eigen::Vector3d& p);
// Its derivative by p (3 x 3).
Eigen::Matrix3d TrackerReadingByPoint(const Corrections<double>& corrections,
                                      const Eigen::Vector3d& p);
// Its change where the corrections move by `motion`.
Eigen::Vector3d TrackerReadingBy(const Corrections<double>& corrections,
                                 const Eigen::Vector3d& p,
                                 const Corrections<double>& motion);
// Where the point is that the tracker reads so: TrackerReading turned round, by Newton's method.
// NaN where no point is found (a distortion so large that readings fold over).
Eigen::Vector3d PointOfReading(const Corrections<double>& corrections,
                               const Eigen::Vector3d& reading);

// Kind poses has no marker to displace: a tracker that scales (tracker_scale) and stands
// tracker_twist away moves the measured pose: world = the tracker's frame.
Pose3d TrackerPoseReading(const Corrections<double>& corrections, const Pose3d& world_from_tool);
// The pose that is read so.
Pose3d PoseOfReading(const Corrections<double>& corrections, const Pose3d& reading);

}  // namespace hexcal
