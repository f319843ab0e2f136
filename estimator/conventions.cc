// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/conventions.h"

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "estimator/closed_form.h"
#include "estimator/rms.h"
#include "geometry/quaternion_order.h"
#include "geometry/rotation_order.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostRows = 100;
constexpr std::size_t kFewestRows = 6;
constexpr double kAlike = 2.0;  // gains within this factor of the best

// The pose as this reading has it. vector and pose are as read by the stated one.
Pose3d PoseBy(const RobotReading& reading, const StatedPose& read) {
  Pose3d pose = read.base_from_platform;
  if (read.vector) {
    const Eigen::Vector3d angles = reading.angle_factor * read.vector->tail<3>();
    pose = MakePose(RotationByOrder(reading.order, angles), read.vector->head<3>());
  } else if (reading.quaternion_shift != 0) {
    pose.rotation = Shifted(pose.rotation, reading.quaternion_shift);
  }
  if (reading.is_transposed) pose.rotation = pose.rotation.conjugate();
  pose.translation *= reading.length_factor;
  return reading.is_inverse ? pose.Inverse() : pose;
}

std::vector<RobotReading> Readings(const RobotReading& stated) {
  std::vector<RobotReading> readings = {stated};
  const auto multiply = [&readings](auto change, auto values) {
    std::vector<RobotReading> all;
    for (const RobotReading& reading : readings) {
      for (const auto& value : values) {
        all.push_back(reading);
        change(all.back(), value);
      }
    }
    readings = std::move(all);
  };
  const std::vector<bool> both = {false, true};
  if (!stated.order.empty()) {
    multiply([](RobotReading& r, std::string_view order) { r.order = order; }, kRotationOrders);
    multiply([](RobotReading& r, double factor) { r.angle_factor = factor; },
             std::vector<double>{1.0, kPi / 180, 180 / kPi});
  } else {
    multiply([](RobotReading& r, int shift) { r.quaternion_shift = shift; },
             std::vector<int>{0, 1, 3});
  }
  multiply([](RobotReading& r, bool is) { r.is_transposed = is; }, both);
  multiply([](RobotReading& r, double factor) { r.length_factor = factor; },
           std::vector<double>{1.0, 1e-3, 1e3});
  multiply([](RobotReading& r, bool is) { r.is_inverse = is; }, both);
  return readings;
}

int Changes(const RobotReading& a, const RobotReading& b) {
  return (a.order != b.order) + (a.is_transposed != b.is_transposed) +
         (a.quaternion_shift != b.quaternion_shift) + (a.angle_factor != b.angle_factor) +
         (a.length_factor != b.length_factor) + (a.is_inverse != b.is_inverse);
}

// Rows with a pose in all the measured sides, spread over all.
std::vector<std::size_t> ChooseRows(const std::vector<MeasuredReading>& measured) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < measured.front().world_from_tool.size(); ++i)
    if (std::all_of(measured.begin(), measured.end(), [i](const auto& side) {
          return side.world_from_tool[i].has_value();
        }))
      rows.push_back(i);
  if (rows.size() <= kMostRows) return rows;
  std::vector<std::size_t> some;
  for (std::size_t i = 0; i < kMostRows; ++i) some.push_back(rows[i * rows.size() / kMostRows]);
  return some;
}

// What base and tool leave over, never below the rounding.
void Fit(const std::vector<Observation>& observations, ConventionFit& fit) {
  const BaseAndTool mounts = SolveClosedForm(ClosedForm::kShah, observations);
  RmsError rms;
  for (const Observation& seen : observations)
    rms.Add(PoseError(mounts, seen.base_from_platform, seen.world_from_tool));
  const NoiseLevels rounding = Rounding(observations);
  fit.rms_position = rms.Position() + rounding.position;
  fit.rms_orientation = rms.Orientation() + rounding.orientation;
}

double Gain(const ConventionFit& from, const ConventionFit& to) {
  const double gain =
      (from.rms_position * from.rms_orientation) / (to.rms_position * to.rms_orientation);
  return std::isfinite(gain) ? gain : 0.0;
}

}  // namespace

std::optional<Conventions> TryConventions(const std::vector<StatedPose>& poses,
                                          const std::vector<MeasuredReading>& measured,
                                          const RobotReading& stated) {
  const std::vector<std::size_t> rows = ChooseRows(measured);
  if (rows.size() < kFewestRows) return std::nullopt;
  std::vector<Observation> observations(rows.size());
  std::vector<ConventionFit> fits;
  Conventions result;
  for (std::size_t side = 0; side < measured.size(); ++side) {
    for (const RobotReading& reading : Readings(stated)) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        observations[i].base_from_platform = PoseBy(reading, poses[rows[i]]);
        observations[i].world_from_tool = *measured[side].world_from_tool[rows[i]];
      }
      ConventionFit fit{reading, side, Changes(reading, stated) + measured[side].changes, 0.0, 0.0};
      Fit(observations, fit);
      if (fit.changes == 0) result.stated = fit;
      fits.push_back(fit);
    }
  }
  result.tried = fits.size();
  double most = 0.0;
  for (const ConventionFit& fit : fits) most = std::max(most, Gain(result.stated, fit));
  result.best = result.stated;
  result.gain = 1.0;
  if (most <= kAlike) return result;
  int fewest = 100;
  for (const ConventionFit& fit : fits) {
    const double gain = Gain(result.stated, fit);
    const bool is_better = fit.changes < fewest || (fit.changes == fewest && gain > result.gain);
    if (gain * kAlike < most || !is_better) continue;
    fewest = fit.changes;
    result.best = fit;
    result.gain = gain;
  }
  return result;
}

}  // namespace hexcal
