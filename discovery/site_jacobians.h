// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discovery/constellation.h"
#include "model/forward.h"
#include "model/visit.h"

namespace hexcal {

// How one measured pose's error (measured minus predicted, frame T, [m, rad]) and its shape rows
// answer to corrections at each site, to first order at one machine. An effect that is in the
// machine but not in the model leaves column * size in the error.
struct SiteJacobians {
  Matrix6d leg = Matrix6d::Zero(), base_twist, platform_twist, tool_twist;
  Eigen::Matrix<double, 6, 18> base_joints = Eigen::Matrix<double, 6, 18>::Zero(),
                               platform_joints = Eigen::Matrix<double, 6, 18>::Zero();
  Eigen::Matrix<double, 6, 12> mounts;  // base, then tool

  // Of a motion of the corrections at the robot's sites.
  Vector6d Apply(const Corrections<double>& motion) const;
};

// hexapod: null where there is none. corrections: of the effects that the machine already has.
SiteJacobians SitesOf(const Mounts& mounts,
                      const HexapodGeometry* hexapod,
                      const Visit& visit,
                      const Corrections<double>& corrections,
                      const ForwardPose& at);

// What a motion of the tracker's and the markers' corrections does to a seen pose: to the measured
// pose (first), and to its shape rows (base body's, then the tool body's).
struct SeenMotion {
  Vector6d pose = Vector6d::Zero();
  Eigen::VectorXd shape;
};
SeenMotion SeenBy(const SeenPose& seen,
                  const Corrections<double>& corrections,
                  const Corrections<double>& motion);

// Whether a motion is at the tracker or at markers.
bool MovesReadings(const Corrections<double>& motion);

}  // namespace hexcal
