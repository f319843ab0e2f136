// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene.h"

#include <glog/logging.h>

#include <algorithm>

#include "estimator/target_error.h"
#include "report/chart_parts.h"

namespace hexcal {
namespace {

std::size_t MiddleOf(const Observations& observations) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Observation& o : observations.items) mean += o.base_from_platform.translation;
  mean /= static_cast<double>(observations.items.size());
  const auto nearest =
      std::min_element(observations.items.begin(),
                       observations.items.end(),
                       [&](const Observation& a, const Observation& b) {
                         return (a.base_from_platform.translation - mean).squaredNorm() <
                                (b.base_from_platform.translation - mean).squaredNorm();
                       });
  return static_cast<std::size_t>(nearest - observations.items.begin());
}

}  // namespace

Scene MakeScene(const Dataset& dataset,
                const Observations& observations,
                const Estimate& estimate) {
  Scene scene;
  const Observation& shown = observations.items[MiddleOf(observations)];
  const BaseAndTool& mounts = estimate.mounts;
  scene.label = shown.label;
  scene.world_from_base = mounts.world_from_base;
  scene.world_from_platform = mounts.world_from_base * shown.base_from_platform;
  scene.world_from_tool = scene.world_from_platform * mounts.platform_from_tool;
  if (dataset.hexapod)
    for (int leg = 0; leg < kNumLegs; ++leg)
      scene.legs.emplace_back(
          scene.world_from_base * Eigen::Vector3d(dataset.hexapod->base_joints_in_base.col(leg)),
          scene.world_from_platform *
              Eigen::Vector3d(dataset.hexapod->platform_joints_in_platform.col(leg)));
  if (dataset.measurement->kind == Measurement::Kind::kMarkers)
    for (int b = 0; b < 2; ++b) {
      const MarkerBody& body = dataset.measurement->bodies[b];
      const Pose3d world_from_body = b == 0 ? Pose3d{} : scene.world_from_tool;
      for (Eigen::Index k = 0; k < body.p_in_body.cols(); ++k)
        scene.markers.emplace_back((b == 0 ? "base/" : "tool/") + body.markers[k],
                                   world_from_body * Eigen::Vector3d(body.p_in_body.col(k)));
    }
  CHECK_EQ(estimate.poses.size(), observations.items.size());
  const std::size_t stride = StrideOf(observations.items.size());
  for (std::size_t i = 0; i < observations.items.size(); i += stride) {
    const Observation& o = observations.items[i];
    const Pose3d predicted =
        mounts.world_from_base * o.base_from_platform * mounts.platform_from_tool;
    scene.arrows.push_back(
        {o.label,
         predicted.translation,
         predicted.rotation * Eigen::Vector3d(estimate.poses[i].residual.head<3>()),
         {},
         estimate.poses[i].weight > 0.0});
  }
  const Eigen::Matrix<double, 3, 12> j =
      TargetJacobian(mounts, shown.base_from_platform, Eigen::Vector3d::Zero());
  scene.covariance = j * estimate.covariance * j.transpose();
  return scene;
}

Scene MakeScene(const Dataset& dataset, const Discovery& discovery) {
  Estimate estimate = discovery.estimate;
  CHECK_EQ(estimate.poses.size(), discovery.poses.size());
  for (std::size_t i = 0; i < discovery.poses.size(); ++i)
    estimate.poses[i].residual = discovery.poses[i].after;
  Scene scene = MakeScene(dataset, discovery.observations, estimate);
  if (discovery.effects.empty()) return scene;
  const std::size_t stride = StrideOf(discovery.poses.size());
  for (std::size_t i = 0; i < scene.arrows.size(); ++i) {
    const Eigen::Quaterniond world_from_tool =
        discovery.observations.items[i * stride].world_from_tool.rotation;
    scene.arrows[i].before =
        world_from_tool * Eigen::Vector3d(discovery.poses[i * stride].before.head<3>());
  }
  return scene;
}

}  // namespace hexcal
