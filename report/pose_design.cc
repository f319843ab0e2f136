// SPDX-License-Identifier: BSD-3-Clause
#include "report/pose_design.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"
#include "geometry/rotation_angles.h"
#include "model/hexapod.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostCompared = 500;  // rotations, two by two

std::array<std::array<double, 2>, 6> SpanOf(const std::vector<Vector6d>& values) {
  std::array<std::array<double, 2>, 6> span;
  span.fill({std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  for (const Vector6d& v : values)
    for (int i = 0; i < 6; ++i) span[i] = {std::min(span[i][0], v[i]), std::max(span[i][1], v[i])};
  return span;
}

void SetRotations(const Observations& observations, PoseDesign* design) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Observation& o : observations.items)
    sum += o.base_from_platform.rotation.toRotationMatrix();
  const Eigen::Quaterniond mean(NearestRotation(sum));
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Observation& o : observations.items) {
    design->rotations.push_back(
        Log(Eigen::Quaterniond(mean.conjugate() * o.base_from_platform.rotation)));
    squares += design->rotations.back() * design->rotations.back().transpose();
  }
  squares /= static_cast<double>(design->rotations.size());
  const Eigenvalues main = DecomposeSymmetric(squares);  // smallest first
  for (int k = 0; k < 3; ++k) {
    design->rotation_rms[k] = std::sqrt(std::max(main.values[2 - k], 0.0));
    design->main_axes.col(k) = main.vectors.col(2 - k);
  }
}

double LargestAngle(const PoseDesign& design) {
  if (design.rotation_rms.norm() == 0.0) return 0.0;
  std::vector<Eigen::Vector3d> axes = design.rotations;
  // The axis of a small rotation is the more uncertain, and tells the less.
  std::sort(axes.begin(), axes.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return a.squaredNorm() > b.squaredNorm();
  });
  axes.resize((axes.size() + 1) / 2);
  for (Eigen::Vector3d& axis : axes) axis.normalize();
  const std::size_t stride = axes.size() / kMostCompared + 1;
  double smallest_cosine = 1.0;
  for (std::size_t i = 0; i < axes.size(); i += stride)
    for (std::size_t j = 0; j < i; j += stride)
      smallest_cosine = std::min(smallest_cosine, std::abs(axes[i].dot(axes[j])));
  return std::acos(smallest_cosine);
}

}  // namespace

PoseDesign PoseDesignOf(const Dataset& dataset, const Observations& observations) {
  PoseDesign design;
  for (const Observation& o : observations.items) {
    design.labels.push_back(o.label);
    design.poses.push_back(VectorFromPose(o.base_from_platform));
    if (dataset.hexapod)
      design.legs.push_back(InverseKinematics(*dataset.hexapod, o.base_from_platform));
  }
  design.span = SpanOf(design.poses);
  design.leg_span = SpanOf(design.legs);
  if (dataset.hexapod && dataset.hexapod->leg_limits)
    design.leg_limits = {{(*dataset.hexapod->leg_limits)[0], (*dataset.hexapod->leg_limits)[1]}};
  SetRotations(observations, &design);
  design.angle_between_axes = LargestAngle(design);
  return design;
}

}  // namespace hexcal
