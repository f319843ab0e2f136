// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hexcal::hidden {
namespace {

using Square = Eigen::Matrix<double, 6, 6>;

// How the whitened readings move with a right twist of one body alone: 0 base, 1 tool.
Eigen::Matrix<double, 12, 6> BodySlope(const Scene& scene, const Row& row, int body) {
  const Markers& markers = body == 0 ? scene.base_markers : scene.tool_markers;
  const Motion tracker_from_body =
      body == 0 ? row.tracker_from_world : row.tracker_from_world * TrueTool(scene, row, {});
  Eigen::Matrix<double, 12, 6> slope;
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 6; ++k) {
    const Six d = kStep * Six::Unit(k);
    const Motion plus = Moved(tracker_from_body, d), minus = Moved(tracker_from_body, -d);
    for (int m = 0; m < 4; ++m) {
      const Eigen::Vector3d marker = markers.col(m);
      slope.block<3, 1>(3 * m, k) =
          ((plus * marker - minus * marker) / (2 * kStep)).cwiseQuotient(scene.sigma);
    }
  }
  return slope;
}

Square BodyCovariance(const Scene& scene, const Row& row, int body) {
  const Eigen::Matrix<double, 12, 6> slope = BodySlope(scene, row, body);
  return Square(slope.transpose() * slope).inverse();
}

// How the twist of `to` moves with the right twist of an inner frame: by differences.
template <typename Place>
Square TwistSlope(const Place& place) {
  constexpr double kStep = 1e-5;
  Square slope;
  const Motion at = place(Six::Zero());
  for (int k = 0; k < 6; ++k) {
    const Six d = kStep * Six::Unit(k);
    slope.col(k) = (TwistBetween(at, place(d)) - TwistBetween(at, place(-d))) / (2 * kStep);
  }
  return slope;
}

// Root mean square 1 over the measured rows.
double RangeFactor(const Scene& scene, const Row& row) {
  const auto range = [&](const Row& of) {
    return (of.tracker_from_world * TrueTool(scene, of, {})).shift.norm();
  };
  double nearest = range(row), farthest = nearest, square = 0.0;
  for (const Row& of : scene.rows) {
    if (!of.is_measured) continue;
    nearest = std::min(nearest, range(of));
    farthest = std::max(farthest, range(of));
  }
  const auto factor = [&](const Row& of) {
    return 1.0 + 2.0 * (range(of) - nearest) / (farthest - nearest);
  };
  for (const Row& of : scene.rows)
    if (of.is_measured) square += factor(of) * factor(of) / scene.MeasuredRows();
  return factor(row) / std::sqrt(square);
}

// By what the stated sigma is multiplied in the mean.
double RegimeScale(const Scene& scene, const Row& row, Regime regime) {
  if (regime == Regime::kUnderstated) return 1.25;
  return regime == Regime::kRangeDependent ? RangeFactor(scene, row) : 1.0;
}

double RobotShare(Regime regime) {
  if (regime == Regime::kHalfRepeat) return 0.5;
  return regime == Regime::kFullRepeat ? 1.0 : 0.0;
}

Six DrawTwist(const Square& covariance, const Six& normals) {
  return covariance.llt().matrixL() * normals;
}

// By how much the robot misses a pose.
Six DrawSlip(const Scene& scene, const Row& row, Regime regime, Dice* dice) {
  const double share = RobotShare(regime);
  const bool is_off = regime == Regime::kOutliers && dice->Chance(0.05);
  if (share == 0 && !is_off) return Six::Zero();
  const Six normals = dice->Normals(6);
  const double size = is_off ? dice->Uniform(5, 20) / normals.norm() : share;
  return DrawTwist(SeenPlatformCovariance(scene, row), size * normals);
}

}  // namespace

const std::vector<std::pair<Regime, std::string>>& Regimes() {
  static const std::vector<std::pair<Regime, std::string>> all = {
      {Regime::kWhite, "white"},
      {Regime::kHeavyTails, "t5"},
      {Regime::kOutliers, "outliers"},
      {Regime::kRangeDependent, "range"},
      {Regime::kUnderstated, "understated"},
      {Regime::kVaryingScale, "varying"},
      {Regime::kHalfRepeat, "half_repeat"},
      {Regime::kFullRepeat, "full_repeat"},
      {Regime::kSerial, "serial"}};
  return all;
}

std::optional<Regime> FindRegime(const std::string& name) {
  for (const auto& [regime, known] : Regimes())
    if (known == name) return regime;
  return std::nullopt;
}

Eigen::Matrix<double, 6, 6> SeenPoseCovariance(const Scene& scene, const Row& row) {
  // world_from_tool = (tracker_from_world)^-1 tracker_from_tool: both bodies' errors count.
  const Motion world = row.tracker_from_world, tool = world * TrueTool(scene, row, {});
  const Square by_world = TwistSlope([&](const Six& d) { return Inverse(Moved(world, d)) * tool; });
  const Square by_tool = TwistSlope([&](const Six& d) { return Inverse(world) * Moved(tool, d); });
  return by_world * BodyCovariance(scene, row, 0) * by_world.transpose() +
         by_tool * BodyCovariance(scene, row, 1) * by_tool.transpose();
}

Eigen::Matrix<double, 6, 6> SeenPlatformCovariance(const Scene& scene, const Row& row) {
  const Motion platform_from_tool = scene.platform_from_tool;
  const Square by_tool = TwistSlope(
      [&](const Six& d) { return Moved(platform_from_tool, d) * Inverse(platform_from_tool); });
  return by_tool * SeenPoseCovariance(scene, row) * by_tool.transpose();
}

ReadingCovariance NoiseCovariance(const Scene& scene, const Row& row, Regime regime) {
  const Reading sigma = RegimeScale(scene, row, regime) * scene.sigma.replicate(8, 1);
  ReadingCovariance covariance = sigma.cwiseAbs2().asDiagonal();
  if (RobotShare(regime) == 0) return covariance;
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, 24, 6> by_slip;
  for (int k = 0; k < 6; ++k) {
    const Six d = kStep * Six::Unit(k);
    by_slip.col(k) =
        (TrueReading(scene, row, {}, d) - TrueReading(scene, row, {}, -d)) / (2 * kStep);
  }
  return covariance + std::pow(RobotShare(regime), 2) * by_slip *
                          SeenPlatformCovariance(scene, row) * by_slip.transpose();
}

std::vector<Reading> NoisyReadings(const Scene& scene,
                                   const std::vector<HiddenEffect>& effects,
                                   Regime regime,
                                   Dice* dice) {
  std::vector<Reading> readings;
  Reading before = dice->Normals(24);
  for (const Row& row : scene.rows) {
    if (!row.is_measured) continue;
    const Six slip = DrawSlip(scene, row, regime, dice);
    Reading noise = dice->Normals(24);
    if (regime == Regime::kHeavyTails)
      for (double& x : noise) x = dice->HeavyTailed(5);
    if (regime == Regime::kSerial) noise = 0.8 * before + std::sqrt(1 - 0.64) * noise;
    before = noise;
    noise *= RegimeScale(scene, row, regime);
    // Log-normal with mean square 1.
    if (regime == Regime::kVaryingScale) noise *= std::exp(0.4 * dice->Normal() - 0.16);
    readings.push_back(TrueReading(scene, row, Sum(effects, scene, row), slip) +
                       noise.cwiseProduct(scene.sigma.replicate(8, 1)));
  }
  return readings;
}

}  // namespace hexcal::hidden
