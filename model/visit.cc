// SPDX-License-Identifier: BSD-3-Clause
#include "model/visit.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "geometry/align_points.h"
#include "measurement/covariates.h"

namespace hexcal {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kStill = 1e-9;  // m: forward kinematics repeats itself to less
constexpr std::array<std::string_view, 6> kVelocities = {"vx", "vy", "vz", "wx", "wy", "wz"};
constexpr std::array<std::string_view, 3> kCentre = {"payload_x", "payload_y", "payload_z"};

const Covariate* FindCovariate(const Dataset& dataset, std::string_view name) {
  for (const Covariate& covariate : dataset.robot_poses.covariates)
    if (covariate.name == name) return &covariate;
  return nullptr;
}

double ValueOf(const Dataset& dataset, std::string_view name, int row, double otherwise) {
  const Covariate* covariate = FindCovariate(dataset, name);
  return covariate == nullptr ? otherwise : covariate->values[row];
}

bool HasVelocity(const Dataset& dataset) {
  for (const std::string_view name : kVelocities)
    if (FindCovariate(dataset, name) == nullptr) return false;
  return true;
}

}  // namespace

Drivers DriversOf(const Dataset& dataset) {
  Drivers drivers;
  drivers.legs = dataset.hexapod.has_value();
  drivers.time = FindCovariate(dataset, "time") != nullptr;
  drivers.temperature = FindCovariate(dataset, "temperature") != nullptr;
  drivers.payload = FindCovariate(dataset, "payload") != nullptr;
  drivers.gravity = dataset.gravity_in_base.has_value();
  drivers.velocity = HasVelocity(dataset);
  drivers.order = dataset.robot_poses.rows.size() > 1;
  drivers.markers = dataset.measurement && dataset.measurement->kind == Measurement::Kind::kMarkers;
  return drivers;
}

Pose3d HomePose(const HexapodGeometry* hexapod, const std::vector<Pose3d>& reported) {
  if (hexapod != nullptr && hexapod->home) return *hexapod->home;
  if (reported.empty()) return Pose3d();
  Eigen::Vector3d translations = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotations = Eigen::Matrix3d::Zero();
  for (const Pose3d& pose : reported) {
    translations += pose.translation;
    rotations += pose.rotation.toRotationMatrix();
  }
  return MakePose(NearestRotation(rotations), translations / reported.size());
}

VisitSequence::VisitSequence(const Dataset& dataset,
                             const HexapodGeometry* hexapod,
                             const std::vector<Pose3d>& reported)
    : dataset_(dataset), hexapod_(hexapod), reported_(reported) {
  CHECK_EQ(reported.size(), dataset.robot_poses.rows.size());
  if (hexapod == nullptr) return;
  plates_ = std::make_shared<const Plates>(PlatesOf(*hexapod));
  const Pose3d home = HomePose(hexapod, reported);
  home_lengths_ = InverseKinematics(*hexapod, home);
  home_roll_ = LegRoll(*plates_, home);
  lengths_ = home_lengths_;
}

Visit VisitSequence::Next() {
  CHECK_LT(static_cast<std::size_t>(row_), reported_.size());
  Visit visit;
  visit.row = row_;
  visit.base_from_platform = reported_[row_];
  ReadCovariates(visit);
  if (hexapod_ != nullptr) MoveLegs(visit);
  ++row_;
  return visit;
}

void VisitSequence::ReadCovariates(Visit& visit) const {
  visit.time = ValueOf(dataset_, "time", row_, kNotKnown);
  visit.temperature = ValueOf(dataset_, "temperature", row_, kNotKnown);
  visit.payload = ValueOf(dataset_, "payload", row_, kNotKnown);
  for (int k = 0; k < 3; ++k) visit.payload_centre[k] = ValueOf(dataset_, kCentre[k], row_, 0.0);
  visit.gravity_in_base = dataset_.gravity_in_base.value_or(Eigen::Vector3d::Constant(kNotKnown));
  for (int k = 0; k < 6; ++k)
    visit.velocity[k] = ValueOf(dataset_, kVelocities[k], row_, kNotKnown);
  for (const Covariate& covariate : dataset_.robot_poses.covariates)
    if (!HasMeaning(covariate.name)) visit.others[covariate.name] = covariate.values[row_];
}

void VisitSequence::MoveLegs(Visit& visit) {
  const RobotPoses& robot_poses = dataset_.robot_poses;
  const Pose3d& pose = visit.base_from_platform;
  visit.plates = plates_;
  visit.lengths =
      robot_poses.are_leg_lengths
          ? LegLengths(Eigen::Map<const LegLengths>(robot_poses.rows[row_].leg_lengths.data()))
          : InverseKinematics(*hexapod_, pose);
  visit.home_lengths = home_lengths_;
  visit.last_move = visit.lengths - lengths_;
  for (int i = 0; i < kNumLegs; ++i) {
    const double move = visit.last_move[i];
    if (std::abs(move) > kStill) direction_[i] = move > 0.0 ? 1.0 : -1.0;
    visit.direction[i] = ValueOf(dataset_, fmt::format("direction_{}", i + 1), row_, direction_[i]);
  }
  visit.legs_in_base = LegsInBase(*plates_, pose);
  const Vector6d roll = LegRoll(*plates_, pose);
  for (int i = 0; i < kNumLegs; ++i)
    visit.roll[i] = std::remainder(roll[i] - home_roll_[i], 2.0 * M_PI);
  visit.home_roll = home_roll_;
  const Matrix36d platform_axes = pose.rotation.toRotationMatrix() * plates_->platform_axes;
  visit.base_axis_cosine = (visit.legs_in_base.cwiseProduct(plates_->base_axes)).colwise().sum();
  visit.platform_axis_cosine = (visit.legs_in_base.cwiseProduct(platform_axes)).colwise().sum();
  visit.leg_jacobian = LegJacobian(*hexapod_, pose);
  lengths_ = visit.lengths;
}

std::vector<Visit> MakeVisits(const Dataset& dataset,
                              const HexapodGeometry* hexapod,
                              const std::vector<Pose3d>& reported) {
  VisitSequence sequence(dataset, hexapod, reported);
  std::vector<Visit> visits;
  visits.reserve(reported.size());
  for (std::size_t row = 0; row < reported.size(); ++row) visits.push_back(sequence.Next());
  return visits;
}

}  // namespace hexcal
