// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "model/hexapod.h"

namespace hexcal {
namespace {

constexpr std::size_t kPoses = 1024;
constexpr double kHeight = 0.5;  // m

// Joints in pairs on circles of 0.4 m and 0.22 m.
HexapodGeometry Hexapod() {
  HexapodGeometry hexapod;
  for (int i = 0; i < kNumLegs; ++i) {
    const double third = 2.0 * M_PI / 3.0 * (i / 2), sign = i % 2 == 0 ? -1.0 : 1.0;
    const double base = third + 0.15 * sign, platform = third + 0.85 * sign;
    hexapod.base_joints_in_base.col(i) << 0.4 * std::cos(base), 0.4 * std::sin(base), 0.0;
    hexapod.platform_joints_in_platform.col(i) << 0.22 * std::cos(platform),
        0.22 * std::sin(platform), 0.0;
  }
  return hexapod;
}

// Within 0.1 m and about 20 deg of the centre of the travel; the same in every run.
std::vector<Pose3d> Poses() {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Pose3d> poses;
  for (std::size_t i = 0; i < kPoses; ++i) {
    const Eigen::Vector3d shift(unit(rng), unit(rng), unit(rng));
    const Eigen::Vector3d turn(unit(rng), unit(rng), unit(rng));
    poses.push_back(
        {Eigen::Vector3d(0, 0, kHeight) + 0.1 * shift, Exp(Eigen::Vector3d(0.2 * turn))});
  }
  return poses;
}

void BM_InverseKinematics(benchmark::State& state) {
  const HexapodGeometry hexapod = Hexapod();
  const std::vector<Pose3d> poses = Poses();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(InverseKinematics(hexapod, poses[i]));
    i = (i + 1) % kPoses;
  }
}
BENCHMARK(BM_InverseKinematics);

void BM_LegJacobian(benchmark::State& state) {
  const HexapodGeometry hexapod = Hexapod();
  const std::vector<Pose3d> poses = Poses();
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(LegJacobian(hexapod, poses[i]));
    i = (i + 1) % kPoses;
  }
}
BENCHMARK(BM_LegJacobian);

// From the neutral pose, as every row of a dataset of leg lengths is solved.
void BM_ForwardKinematics(benchmark::State& state) {
  const HexapodGeometry hexapod = Hexapod();
  std::vector<LegLengths> lengths;
  for (const Pose3d& pose : Poses()) lengths.push_back(InverseKinematics(hexapod, pose));
  std::size_t i = 0;
  double iterations = 0.0;
  for (auto _ : state) {
    const ForwardKinematicsResult result =
        ForwardKinematics(hexapod, lengths[i], NeutralPose(hexapod, lengths[i]));
    if (!result.converged) state.SkipWithError("forward kinematics did not converge");
    iterations += result.iterations;
    i = (i + 1) % kPoses;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(BM_ForwardKinematics);

}  // namespace
}  // namespace hexcal
