// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "estimator/calibrate_grown.h"
#include "estimator/error_length.h"
#include "estimator/target_error.h"
#include "model/predict.h"
#include "model/simulate.h"
#include "testing/effects.h"
#include "testing/grown_scene.h"

namespace hexcal::testing {

// A machine with effects, and a place that none of its poses is at.
struct ModelScene {
  Dataset plan;
  Machine truth;
  Machine model;     // the effects of another day: half of what they are
  Dataset at_place;  // one row: the place, visited after the plan
  Eigen::Vector3d p_in_tool = {0.03, -0.02, 0.15};

  const Pose3d& place() const { return at_place.robot_poses.rows[0].base_from_platform; }
  Eigen::Vector3d Truth() const { return Predict(truth, at_place)[0] * p_in_tool; }
};

inline double ValueAfterAll(const Covariate& column) {
  if (column.name == "time") return column.values.back();
  if (column.name[0] == 'v' || column.name[0] == 'w') return 0.0;
  double sum = 0.0;
  for (const double value : column.values) sum += value;
  return sum / static_cast<double>(column.values.size());
}

// poses: at most kGrownPoses.
template <typename Rng>
ModelScene MakeModelScene(Rng& rng, const std::vector<std::string>& effects, int poses) {
  ModelScene scene;
  scene.plan = Plan(rng, false);
  scene.plan.hexapod->home = Pose3d{{0.0, 0.0, kLargeHeight}, Eigen::Quaterniond::Identity()};
  scene.plan.robot_poses.rows.resize(poses);
  for (Covariate& column : scene.plan.robot_poses.covariates) column.values.resize(poses);
  scene.truth = TrueMachine(rng);
  scene.truth.hexapod = scene.plan.hexapod;
  const std::vector<Visit> visits =
      MakeVisits(scene.plan, &*scene.plan.hexapod, ReportedPoses(scene.plan));
  for (const std::string& name : effects)
    scene.truth.effects.push_back(SomeEffect(rng, *FindEffectKind(name), visits, scene.plan, 1.0));
  scene.model = scene.truth;
  for (Effect& effect : scene.model.effects) effect.parameters *= 0.5;
  scene.at_place = scene.plan;
  scene.at_place.measurement.reset();
  RobotPoses& row = scene.at_place.robot_poses;
  row.rows.resize(1);
  row.rows[0].base_from_platform = SmallPose(rng, 0.05, 0.2);
  row.rows[0].base_from_platform.translation.z() += kLargeHeight;
  for (Covariate& column : row.covariates) column.values = {ValueAfterAll(column)};
  return scene;
}

struct ModelCalibration {
  Dataset dataset;  // the solution refers to it
  GrownCalibration grown;
  std::shared_ptr<const GrownTarget> target;
};

// Measured poses with one noise along all axes, as is assumed where the noise is not stated.
inline Dataset PlanOfPoses(const Dataset& plan) {
  Dataset poses = plan;
  Measurement& measurement = poses.measurement.emplace();
  measurement.kind = Measurement::Kind::kPoses;
  measurement.pose_noise =
      PoseNoise{Eigen::Vector3d::Constant(3e-5), Eigen::Vector3d::Constant(1.5e-4)};
  return poses;
}

// Of one drawn measurement, of markers with their noise stated, or of poses without.
inline std::unique_ptr<ModelCalibration> CalibrateModel(const ModelScene& scene,
                                                        std::uint64_t seed,
                                                        bool is_stated) {
  auto made = std::make_unique<ModelCalibration>();
  made->dataset =
      Simulate(is_stated ? scene.plan : PlanOfPoses(scene.plan), scene.truth, {seed, 1.0, true});
  if (!is_stated) made->dataset.measurement->pose_noise.reset();
  made->grown = CalibrateGrown(made->dataset, scene.model, {});
  made->target = std::make_shared<const GrownTarget>(made->grown.solution);
  return made;
}

// Whether the point is as near to where it is predicted as the 95 % length says.
inline bool IsWithinLength(const ModelScene& scene, const ModelCalibration& made) {
  const TargetCovariance at =
      TargetError(made.grown.estimate, {}, made.target).At(scene.place(), scene.p_in_tool);
  const double length = (at.p_in_world - scene.Truth()).norm();
  // As length <= at.Quantile(0.95), and quicker.
  return LengthTail(at.total, length, at.degrees_of_freedom) >= 0.05;
}

}  // namespace hexcal::testing
