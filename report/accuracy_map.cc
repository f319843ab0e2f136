// SPDX-License-Identifier: BSD-3-Clause
#include "report/accuracy_map.h"

#include <cmath>
#include <limits>
#include <optional>

#include "geometry/rotation_angles.h"

namespace hexcal {
namespace {

constexpr int kAcross = 9;  // positions along x and y
constexpr int kHeights = 3, kTurns = 3;

std::vector<double> Levels(const std::array<double, 2>& range, int count) {
  std::vector<double> levels;
  for (int i = 0; i < count; ++i)
    levels.push_back(range[0] + (range[1] - range[0]) * i / (count - 1));
  return levels;
}

class Mapping {
 public:
  Mapping(const TargetError& error,
          const Eigen::Vector3d& p_in_tool,
          const Workspace& workspace,
          const Dataset& dataset,
          double probability)
      : error_(error), p_in_tool_(p_in_tool), dataset_(dataset), probability_(probability) {
    for (int i = 0; i < 3; ++i) turns_[i] = Levels(workspace.box[3 + i], kTurns);
  }

  // The orientation with the largest variance.
  double At(double x, double y, double z) const {
    std::optional<TargetCovariance> worst;
    for (const double rx : turns_[0])
      for (const double ry : turns_[1])
        for (const double rz : turns_[2]) {
          Vector6d pose_vector;
          pose_vector << x, y, z, rx, ry, rz;
          const Pose3d pose = PoseFromVector(pose_vector);
          if (!IsReached(dataset_, pose)) continue;
          TargetCovariance at = error_.At(pose, p_in_tool_);
          if (!std::isfinite(at.total.trace())) continue;  // effects put it out of reach
          if (!worst || at.total.trace() > worst->total.trace()) worst = std::move(at);
        }
    return worst ? worst->Quantile(probability_) : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  const TargetError& error_;
  const Eigen::Vector3d p_in_tool_;
  const Dataset& dataset_;
  const double probability_;
  std::array<std::vector<double>, 3> turns_;
};

}  // namespace

AccuracyMap MapAccuracy(const TargetError& error,
                        const Eigen::Vector3d& p_in_tool,
                        const Workspace& workspace,
                        const Dataset& dataset,
                        double probability) {
  AccuracyMap map;
  map.x = Levels(workspace.box[0], kAcross);
  map.y = Levels(workspace.box[1], kAcross);
  map.z = Levels(workspace.box[2], kHeights);
  const Mapping mapping(error, p_in_tool, workspace, dataset, probability);
  for (const double z : map.z) {
    map.lengths.emplace_back();
    for (const double y : map.y) {
      map.lengths.back().emplace_back();
      for (const double x : map.x) map.lengths.back().back().push_back(mapping.At(x, y, z));
    }
  }
  return map;
}

}  // namespace hexcal
