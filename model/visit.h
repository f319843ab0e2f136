// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "model/hexapod.h"

namespace hexcal {

// What may drive an effect in one row of robot_poses, in SI and degC, all by the nominal hexapod.
// NaN: the dataset does not tell.
struct Visit {
  int row = 0;                // of robot_poses, in the order of the visits
  Pose3d base_from_platform;  // as the controller reports it
  double time = 0.0;          // s
  double temperature = 0.0;   // degC
  double payload = 0.0;       // kg
  Eigen::Vector3d payload_centre = Eigen::Vector3d::Zero();   // frame A, m; zero where not given
  Eigen::Vector3d gravity_in_base = Eigen::Vector3d::Zero();  // unit vector
  Vector6d velocity = Vector6d::Zero();  // of A when read, frame A, [m/s, rad/s]

  // With a hexapod; else all zero.
  LegLengths lengths = LegLengths::Zero();       // that the controller reports, m
  LegLengths home_lengths = LegLengths::Zero();  // at the centre of the travel, m
  LegLengths last_move = LegLengths::Zero();     // lengths minus those of the visit before; the
                                                 // first visit comes from the centre of the travel
  Vector6d direction = Vector6d::Zero();         // sign of each leg's last move, as recorded or as
                                                 // last_move tells
  Matrix36d legs_in_base = Matrix36d::Zero();    // unit vectors, base joint to platform joint
  Vector6d roll = Vector6d::Zero();  // turn of each leg's upper joint against its lower one about
                                     // the leg, from that at the centre of the travel, rad
  Vector6d base_axis_cosine = Vector6d::Zero();      // between a leg and the first axis of its
  Vector6d platform_axis_cosine = Vector6d::Zero();  // joint on the base, on the platform
  Matrix6d leg_jacobian = Matrix6d::Zero();          // LegJacobian at base_from_platform
};

// Which drivers a dataset has.
struct Drivers {
  bool legs = false;  // a hexapod
  bool time = false;  // a column; drifts and steps count rows without it
  bool temperature = false, payload = false, gravity = false, velocity = false;
  bool order = false;    // more than one visit
  bool markers = false;  // readings per marker
};
Drivers DriversOf(const Dataset& dataset);

// All rows. hexapod: the nominal one, null where there is none. reported: base_from_platform of
// each row (ReportedPoses, faults of the data already mended).
std::vector<Visit> MakeVisits(const Dataset& dataset,
                              const HexapodGeometry* hexapod,
                              const std::vector<Pose3d>& reported);

}  // namespace hexcal
