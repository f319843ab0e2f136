// SPDX-License-Identifier: BSD-3-Clause
// How often 95 % intervals and the 95 % ellipsoid of the 12 parameters hold the truth, from
// repeated draws of the noise.
//   coverage_study [--draws=10000] [--poses=0]
#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "estimator/calibrate.h"
#include "estimator/quantiles.h"
#include "methods.h"

DEFINE_int32(draws, 10000, "draws for each row");
DEFINE_int32(poses, 0, "this number of poses only");

namespace hexcal {
namespace {

constexpr double kLevel = 0.95;

// What an estimate claims: how many sigmas make its intervals, and how large e' C^-1 e may be.
struct Claim {
  Vector12d sigmas;
  double ellipsoid = 0.0;
};

Claim NoiseGiven(const Estimate&) {
  return {Vector12d::Constant(std::sqrt(ChiSquareQuantile(kLevel, 1.0))),
          ChiSquareQuantile(kLevel, 12.0)};
}

Claim NoiseEstimated(const Estimate& estimate) {
  const double dof = estimate.degrees_of_freedom;
  return {Vector12d::Constant(StudentTQuantile(0.5 + 0.5 * kLevel, dof)),
          12.0 * FisherFQuantile(kLevel, 12.0, dof)};
}

struct Case {
  const char* name;
  int poses;
  std::function<Observations(const StudyScene&, int draw)> measure;
  std::function<Claim(const Estimate&)> claim;
};

struct Coverage {
  Vector12d intervals = Vector12d::Zero();  // part of the draws
  double ellipsoid = 0.0;
};

Coverage Study(const Case& c, const StudyScene& scene) {
  Coverage coverage;
  const double part = 1.0 / FLAGS_draws;
  for (int i = 0; i < FLAGS_draws; ++i) {
    const Observations observations = c.measure(scene, i);
    const Estimate estimate = Calibrate(observations, {}, {});
    CHECK(estimate.IsTrustworthy()) << estimate.message;
    const Claim claim = c.claim(estimate);
    const Vector12d error = Error(estimate.mounts, scene.truth);
    const Vector12d width = claim.sigmas.cwiseProduct(estimate.covariance.diagonal().cwiseSqrt());
    coverage.intervals += part * (error.array().abs() <= width.array()).cast<double>().matrix();
    const double distance = error.dot(Vector12d(estimate.covariance.llt().solve(error)));
    if (distance <= claim.ellipsoid) coverage.ellipsoid += part;
  }
  return coverage;
}

const std::vector<Case>& Cases() {
  const auto stated = [](const StudyScene& scene, int draw) { return Draw(scene, draw); };
  const auto unknown = [](const StudyScene& scene, int draw) { return Draw(scene, draw, false); };
  static const std::vector<Case> cases = {
      {"by pose, noise given", 60, stated, NoiseGiven},
      {"by pose, noise estimated", 60, unknown, NoiseEstimated},
      {"by pose, noise given", 10, stated, NoiseGiven},
      {"by pose, noise estimated", 10, unknown, NoiseEstimated},
  };
  return cases;
}

void Run() {
  fmt::print(
      "| poses | case | draws | 12 intervals, % | lowest to highest, % | ellipsoid, % |\n"
      "| ---: | --- | ---: | ---: | --- | ---: |\n");
  for (const Case& c : Cases()) {
    if (FLAGS_poses != 0 && FLAGS_poses != c.poses) continue;
    const Coverage coverage = Study(c, MakeStudyScene(c.poses, IsotropicNoise(), 100 + c.poses));
    fmt::print("| {} | {} | {} | {:.2f} | {:.2f} to {:.2f} | {:.2f} |\n",
               c.poses,
               c.name,
               FLAGS_draws,
               100.0 * coverage.intervals.mean(),
               100.0 * coverage.intervals.minCoeff(),
               100.0 * coverage.intervals.maxCoeff(),
               100.0 * coverage.ellipsoid);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  google::InitGoogleLogging(argv[0]);
  hexcal::Run();
}
