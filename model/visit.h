// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "model/hexapod.h"
#include "model/plates.h"

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
  std::map<std::string, double> others;  // covariates that have no meaning of their own

  // With a hexapod; else all zero.
  LegLengths lengths = LegLengths::Zero();       // that the controller reports, m
  LegLengths home_lengths = LegLengths::Zero();  // at the centre of the travel, m
  LegLengths last_move = LegLengths::Zero();     // lengths minus those of the visit before; the
                                                 // first visit comes from the centre of the travel
  Vector6d direction = Vector6d::Zero();         // sign of each leg's last move, as recorded or as
                                          // last_move tells; of a leg that stood still (1 nm)
                                          // that of the visit before
  Matrix36d legs_in_base = Matrix36d::Zero();  // unit vectors, base joint to platform joint
  Vector6d roll = Vector6d::Zero();  // turn of each leg's upper joint against its lower one about
                                     // the leg, from that at the centre of the travel, rad
  Vector6d home_roll = Vector6d::Zero();             // LegRoll at the centre of the travel, rad
  Vector6d base_axis_cosine = Vector6d::Zero();      // between a leg and the first axis of its
  Vector6d platform_axis_cosine = Vector6d::Zero();  // joint on the base, on the platform
  Matrix6d leg_jacobian = Matrix6d::Zero();          // LegJacobian at base_from_platform
  std::shared_ptr<const Plates> plates;              // null without a hexapod
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

// The centre of the travel: the hexapod's home, else the mean of the reported poses (of positions;
// of rotations the nearest to their sum). A hexapod that is kept for other data than these should
// be given this home. Identity where there is no pose.
Pose3d HomePose(const HexapodGeometry* hexapod, const std::vector<Pose3d>& reported);

// The visits one after another, for tables too long to keep them all. Refers to its arguments,
// which must outlive it.
class VisitSequence {
 public:
  // hexapod: the nominal one, null where there is none. reported: base_from_platform of each row
  // (ReportedPoses, faults of the data already mended).
  VisitSequence(const Dataset& dataset,
                const HexapodGeometry* hexapod,
                const std::vector<Pose3d>& reported);
  // At most as often as there are rows.
  Visit Next();

 private:
  void ReadCovariates(Visit& visit) const;
  void MoveLegs(Visit& visit);

  const Dataset& dataset_;
  const HexapodGeometry* hexapod_;
  const std::vector<Pose3d>& reported_;
  std::shared_ptr<const Plates> plates_;
  LegLengths home_lengths_ = LegLengths::Zero();
  Vector6d home_roll_ = Vector6d::Zero();
  // Of the next visit, and of the one before it.
  int row_ = 0;
  LegLengths lengths_ = LegLengths::Zero();
  Vector6d direction_ = Vector6d::Zero();
};

// All rows.
std::vector<Visit> MakeVisits(const Dataset& dataset,
                              const HexapodGeometry* hexapod,
                              const std::vector<Pose3d>& reported);

}  // namespace hexcal
