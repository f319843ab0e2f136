// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>
#include <string>

#include "geometry/pose.h"

namespace hexcal::testing {

// A generator seeded by the running test's full name: the same draws in every run and in any order
// of tests.
inline std::mt19937_64 SeededByTest() {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::seed_seq seed(name.begin(), name.end());
  return std::mt19937_64(seed);
}

template <typename Rng>
double Uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

template <typename Rng>
Eigen::Vector3d UniformVector(Rng& rng, double half_width) {
  return {Uniform(rng, -half_width, half_width),
          Uniform(rng, -half_width, half_width),
          Uniform(rng, -half_width, half_width)};
}

template <typename Rng>
Eigen::VectorXd Normal(Rng& rng, int size) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd v(size);
  for (int i = 0; i < size; ++i) v[i] = normal(rng);
  return v;
}

// Any rotation, uniformly, and a translation within +-half_width, m.
template <typename Rng>
Pose3d RandomPose(Rng& rng, double half_width) {
  const Eigen::Vector4d q = Normal(rng, 4);
  return {UniformVector(rng, half_width), Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized()};
}

// A translation within +-half_width m and a rotation vector within +-half_angle rad, each axis.
template <typename Rng>
Pose3d SmallPose(Rng& rng, double half_width, double half_angle) {
  return {UniformVector(rng, half_width), Exp(UniformVector(rng, half_angle))};
}

}  // namespace hexcal::testing
