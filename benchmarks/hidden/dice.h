// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>

namespace hexcal::hidden {

// Random draws of one case.
class Dice {
 public:
  // Case `number` of a series: the same draws whatever was drawn before.
  Dice(std::uint64_t series, std::uint64_t number) {
    std::seed_seq seed{series & 0xffffffffu, series >> 32, number & 0xffffffffu, number >> 32};
    engine_.seed(seed);
  }

  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }
  double Normal() { return normal_(engine_); }
  Eigen::VectorXd Normals(int size) {
    Eigen::VectorXd v(size);
    for (double& x : v) x = Normal();
    return v;
  }
  // 0 ... sides - 1.
  int Below(int sides) { return std::uniform_int_distribution<int>(0, sides - 1)(engine_); }
  bool Chance(double share) { return Uniform(0, 1) < share; }
  double Sign() { return Chance(0.5) ? 1.0 : -1.0; }
  // Student's t of `degrees`, scaled to variance 1.
  double HeavyTailed(double degrees) {
    const double t = std::student_t_distribution<double>(degrees)(engine_);
    return t * std::sqrt((degrees - 2.0) / degrees);
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace hexcal::hidden
