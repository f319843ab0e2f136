// SPDX-License-Identifier: BSD-3-Clause
#include "report/held_out.h"

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kProbability = 0.95;
// Below, what each pose is held against is as good as the same: the law of independent ones has it
// that almost none may lie outside, where in truth they do so together.
constexpr int kFewestTested = 6;

// The largest k with a probability of 99 % or more that k or more of n lie inside, each with 95 %
// (the binomial distribution).
int FewestInside(int n) {
  constexpr double kSure = 0.99;
  double of_this = std::pow(1.0 - kProbability, n);  // the probability of exactly k inside
  double of_fewer = 0.0;
  int k = 0;
  while (k < n && of_fewer + of_this <= 1.0 - kSure) {
    of_fewer += of_this;
    of_this *= kProbability / (1.0 - kProbability) * (n - k) / (k + 1);
    ++k;
  }
  return k;
}

}  // namespace

HeldOutTest HeldOutTestOf(const std::vector<PoseCheck>& poses) {
  HeldOutTest test;
  test.poses = static_cast<int>(poses.size());
  if (test.poses >= kFewestTested) test.fewest = FewestInside(test.poses);
  const double limit = ChiSquareQuantile(kProbability, 6.0);
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  for (const PoseCheck& pose : poses) {
    test.inside += pose.squared <= limit;
    squares += Eigen::Vector4d(pose.held_out.head<3>().squaredNorm(),
                               std::pow(pose.expected_position, 2),
                               pose.held_out.tail<3>().squaredNorm(),
                               std::pow(pose.expected_orientation, 2));
  }
  if (test.poses > 0) test.coverage = CoverageOf(test.inside, test.poses, kProbability);
  squares = (squares / std::max(test.poses, 1)).cwiseSqrt();
  test.rms_position = squares[0], test.expected_position = squares[1];
  test.rms_orientation = squares[2], test.expected_orientation = squares[3];
  return test;
}

}  // namespace hexcal
