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
#include "estimator/calibrate_markers.h"
#include "study_markers.h"
#include "study_scene.h"

DEFINE_int32(draws, 10000, "draws for each row");
DEFINE_int32(poses, 0, "this number of poses only");

namespace hexcal {
namespace {

// One draw: what was found, and what is true.
struct Trial {
  Estimate estimate;
  BaseAndTool truth;
};

struct Case {
  std::string name;
  int poses;
  std::function<Trial(int draw)> run;
};

struct Coverage {
  Vector12d intervals = Vector12d::Zero();  // part of the draws
  double ellipsoid = 0.0;
};

Coverage Study(const Case& c) {
  Coverage coverage;
  const double part = 1.0 / FLAGS_draws;
  for (int i = 0; i < FLAGS_draws; ++i) {
    const Trial trial = c.run(i);
    const Estimate& estimate = trial.estimate;
    CHECK(estimate.IsTrustworthy()) << estimate.message;
    const Vector12d error = Error(estimate.mounts, trial.truth);
    const Vector12d& width = estimate.intervals.half_width;
    coverage.intervals += part * (error.array().abs() <= width.array()).cast<double>().matrix();
    const double distance = error.dot(Vector12d(estimate.covariance.llt().solve(error)));
    if (distance <= estimate.intervals.ellipsoid) coverage.ellipsoid += part;
  }
  return coverage;
}

std::vector<Case> PoseCases(int poses) {
  const StudyScene scene = MakeStudyScene(poses, IsotropicNoise(), 100 + poses);
  const auto run = [scene](bool noise_is_given) {
    return [scene, noise_is_given](int draw) {
      return Trial{Calibrate(Draw(scene, draw, noise_is_given), {}, {}), scene.truth};
    };
  };
  return {{"poses; noise given", poses, run(true)}, {"poses; noise estimated", poses, run(false)}};
}

// Each marker unseen in 3 % of the poses; calibrated from the tool poses and from the readings.
std::vector<Case> MarkerCases(int poses) {
  const MarkerStudy study = MakeMarkerStudy(poses, 100 + poses);
  const auto run = [study](bool by_marker, bool noise_is_given) {
    return [=](int draw) {
      const Dataset dataset = DrawMarkers(study, draw, noise_is_given, 0.03);
      const Observations observations = MakeObservations(dataset);
      return Trial{by_marker
                       ? CalibrateMarkers(
                             observations, MakeMarkerObservations(dataset, observations), {}, {})
                       : Calibrate(observations, {}, {}),
                   study.truth};
    };
  };
  return {{"markers, by pose; noise given", poses, run(false, true)},
          {"markers, by pose; noise estimated", poses, run(false, false)},
          {"markers, by marker; noise given", poses, run(true, true)},
          {"markers, by marker; noise estimated", poses, run(true, false)}};
}

void Run() {
  fmt::print(
      "| poses | case | draws | 12 intervals, % | lowest to highest, % | ellipsoid, % |\n"
      "| ---: | --- | ---: | ---: | --- | ---: |\n");
  std::vector<Case> cases;
  for (const int poses : {60, 10}) {
    if (FLAGS_poses != 0 && FLAGS_poses != poses) continue;
    for (const auto& some : {PoseCases(poses), MarkerCases(poses)})
      cases.insert(cases.end(), some.begin(), some.end());
  }
  for (const Case& c : cases) {
    const Coverage coverage = Study(c);
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
