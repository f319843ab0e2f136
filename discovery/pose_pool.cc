// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/pose_pool.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "model/hexapod.h"
#include "model/visit.h"

namespace hexcal {
namespace {

constexpr double kMostTurn = M_PI / 6.0;  // rad; joints seldom allow more
constexpr int kHalvings = 40;
constexpr int kMostTries = 20;   // a pose
constexpr double kSlack = 1e-9;  // m: rounding of leg lengths
// Of the leg Jacobian's determinant at home: below it a pose is near a singular one.
constexpr double kRegular = 0.3;

// The largest part of the way from home that is within reach, to rounding; the way back leads home.
double PartWithinReach(const Reach& reach, const Vector6d& from_home) {
  if (reach.Holds(reach.At(from_home))) return 1.0;
  double within = 0.0, beyond = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (within + beyond);
    (reach.Holds(reach.At(middle * from_home)) ? within : beyond) = middle;
  }
  return within;
}

void Span(const std::vector<Pose3d>& reported, Reach* reach) {
  for (const Pose3d& pose : reported) {
    Vector6d from_home;
    from_home << pose.translation - reach->home.translation,
        Log(Eigen::Quaterniond(reach->home.rotation.conjugate() * pose.rotation));
    reach->low = reach->low.cwiseMin(from_home);
    reach->high = reach->high.cwiseMax(from_home);
  }
}

// As far as the legs' limits go along each axis alone.
void SpanByLimits(Reach* reach) {
  const double travel = reach->leg_limits[1] - reach->leg_limits[0];
  for (int axis = 0; axis < 6; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vector6d far = Vector6d::Zero();
      far[axis] = sign * (axis < 3 ? 2.0 * travel : kMostTurn);
      const double end = far[axis] * PartWithinReach(*reach, far);
      reach->low[axis] = std::min(reach->low[axis], end);
      reach->high[axis] = std::max(reach->high[axis], end);
    }
}

// Digits of i in a base, mirrored at the point (Halton 1960).
double RadicalInverse(int i, int base) {
  double value = 0.0, digit = 1.0;
  for (; i > 0; i /= base) {
    digit /= base;
    value += digit * (i % base);
  }
  return value;
}

// Point i, from 1, of Halton's sequence in the unit cube, shifted around its edges.
Vector6d HaltonPoint(int i, const Vector6d& shift) {
  constexpr std::array<int, 6> kBases = {2, 3, 5, 7, 11, 13};
  Vector6d point = shift;
  for (int k = 0; k < 6; ++k) {
    point[k] += RadicalInverse(i, kBases[k]);
    point[k] -= std::floor(point[k]);
  }
  return point;
}

// Thirds become the two sides and the middle.
Vector6d OnEdge(const Vector6d& point) {
  return point.unaryExpr([](double x) { return x < 1.0 / 3.0 ? 0.0 : x < 2.0 / 3.0 ? 0.5 : 1.0; });
}

}  // namespace

Pose3d Reach::At(const Vector6d& from_home) const {
  const Eigen::Vector3d turn = from_home.tail<3>();
  return {home.translation + from_home.head<3>(), (home.rotation * Exp(turn)).normalized()};
}

bool Reach::Holds(const Pose3d& base_from_platform) const {
  if (!hexapod) return true;
  const LegLengths lengths = InverseKinematics(*hexapod, base_from_platform);
  return lengths.minCoeff() >= leg_limits[0] - kSlack &&
         lengths.maxCoeff() <= leg_limits[1] + kSlack &&
         (home_determinant == 0.0 ||
          LegJacobian(*hexapod, base_from_platform).determinant() / home_determinant >= kRegular);
}

Reach ReachOf(const HexapodGeometry* hexapod, const std::vector<Pose3d>& reported) {
  CHECK(!reported.empty());
  Reach reach;
  reach.home = HomePose(hexapod, reported);
  if (hexapod != nullptr) {
    reach.hexapod = *hexapod;
    LegLengths least = InverseKinematics(*hexapod, reported[0]), most = least;
    for (const Pose3d& pose : reported) {
      const LegLengths lengths = InverseKinematics(*hexapod, pose);
      least = least.cwiseMin(lengths), most = most.cwiseMax(lengths);
    }
    reach.leg_limits =
        hexapod->leg_limits.value_or(Eigen::Vector2d(least.minCoeff(), most.maxCoeff()));
    // The mean of poses may lie outside what they reach.
    if (!reach.Holds(reach.home)) reach.home = reported[0];
    reach.home_determinant = LegJacobian(*hexapod, reach.home).determinant();
  }
  Span(reported, &reach);
  if (hexapod != nullptr && hexapod->leg_limits) SpanByLimits(&reach);
  return reach;
}

std::vector<Pose3d> MakePosePool(const Reach& reach, int count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  Vector6d shift;
  for (double& s : shift) s = std::ldexp(static_cast<double>(generator() >> 11), -53);
  std::vector<Pose3d> pool;
  std::array<int, 2> point = {0, 0};  // of Halton's sequence: inside, on the edge
  std::set<std::array<double, 6>> taken;
  for (int i = 0; i < count; ++i) {
    Vector6d part;
    // Corners come again; a box without width has nothing else.
    for (int tries = 0; tries < kMostTries; ++tries) {
      part = HaltonPoint(++point[i % 2], shift);
      if (i % 2 == 1) part = OnEdge(part);
      std::array<double, 6> key;
      std::copy(part.begin(), part.end(), key.begin());
      if (taken.insert(key).second) break;
    }
    Vector6d from_home = reach.low + part.cwiseProduct(reach.high - reach.low);
    from_home *= PartWithinReach(reach, from_home);
    pool.push_back(reach.At(from_home));
  }
  return pool;
}

}  // namespace hexcal
