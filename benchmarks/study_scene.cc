// SPDX-License-Identifier: BSD-3-Clause
#include "study_scene.h"

#include <Eigen/Cholesky>
#include <string>

#include "residuals/whitener.h"

namespace hexcal {
namespace {

constexpr double kSigmaPosition = 1e-4;     // m
constexpr double kSigmaOrientation = 5e-4;  // rad

Eigen::Vector3d UniformVector(std::mt19937_64& rng, double half_width) {
  std::uniform_real_distribution<double> uniform(-half_width, half_width);
  const double x = uniform(rng), y = uniform(rng), z = uniform(rng);
  return {x, y, z};
}

Vector6d StandardNormal(std::mt19937_64& rng) {
  std::normal_distribution<double> normal;
  Vector6d v;
  for (double& x : v) x = normal(rng);
  return v;
}

Pose3d AnyPose(std::mt19937_64& rng, double half_width) {
  const Eigen::Vector4d q = StandardNormal(rng).head<4>();
  return {UniformVector(rng, half_width), Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized()};
}

Matrix12d Bound(const StudyScene& scene) {
  const Matrix6d whitener = WhitenerOf(scene.noise);
  RowFactor factor(12);
  for (const Observation& o : scene.exact)
    factor.Add(whitener * PoseErrorJacobian(Vector6d::Zero(),
                                            o.base_from_platform * scene.truth.platform_from_tool));
  return Invert(Analyse(factor.R()), 1e-10).covariance;
}

}  // namespace

Matrix6d IsotropicNoise() {
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kSigmaPosition), Eigen::Vector3d::Constant(kSigmaOrientation);
  return sigma.cwiseAbs2().asDiagonal();
}

Matrix6d UnevenNoise() {
  Vector6d ratio;
  ratio << 1, 1, 3, 1, 1, 3;
  return ratio.asDiagonal() * IsotropicNoise() * ratio.asDiagonal();
}

StudyScene MakeStudyScene(int poses, const Matrix6d& noise, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  StudyScene scene;
  scene.truth = {AnyPose(rng, 2.0), AnyPose(rng, 0.3)};
  scene.noise = noise;
  scene.exact.resize(poses);
  for (int i = 0; i < poses; ++i) {
    Observation& o = scene.exact[i];
    o.label = std::to_string(i + 1);
    o.base_from_platform = {UniformVector(rng, 0.04) + Eigen::Vector3d(0, 0, 0.2),
                            Exp(UniformVector(rng, 0.3))};
    o.world_from_tool =
        scene.truth.world_from_base * o.base_from_platform * scene.truth.platform_from_tool;
  }
  scene.bound = Bound(scene);
  return scene;
}

Observations Draw(const StudyScene& scene, std::uint64_t draw, bool noise_is_known) {
  std::seed_seq seed{draw, std::uint64_t{1}};
  std::mt19937_64 rng(seed);
  const Matrix6d root = scene.noise.llt().matrixL();
  Observations observations;
  observations.items = scene.exact;
  observations.tool_noise_is_known = noise_is_known;
  for (Observation& o : observations.items) {
    o.world_from_tool = Plus(o.world_from_tool, Vector6d(root * StandardNormal(rng)));
    if (noise_is_known) o.tool_covariance = scene.noise;
  }
  return observations;
}

Vector12d Error(const BaseAndTool& estimate, const BaseAndTool& truth) {
  Vector12d error;
  error << Minus(estimate.world_from_base, truth.world_from_base),
      Minus(estimate.platform_from_tool, truth.platform_from_tool);
  return error;
}

}  // namespace hexcal
