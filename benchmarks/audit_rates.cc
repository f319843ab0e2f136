// SPDX-License-Identifier: BSD-3-Clause
// How often an audit's tests of the noise and of single readings are right: docs/audit.md has the
// tables that this prints. usage: audit_rates [DRAWS]   (500)

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "estimator/calibrate.h"
#include "estimator/reading_check.h"
#include "report/global_test.h"
#include "testing/marker_scenes.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using Random = std::mt19937_64;
using testing::MarkerScene;
using testing::MarkerTruth;

struct Way {
  const char* name;
  CalibrateOptions options;
};

std::vector<Way> Ways() {
  std::vector<Way> ways = {{"least squares", {}}};
  const auto loss = [&ways](const char* name, LossKind kind, double factor) {
    ways.push_back({name, {}});
    ways.back().options.loss = {kind, factor * DefaultLoss(kind).scale};
  };
  loss("Huber", LossKind::kHuber, 1.0);
  loss("Huber, 0.8 of its scale", LossKind::kHuber, 0.8);
  loss("Cauchy", LossKind::kCauchy, 1.0);
  loss("Tukey", LossKind::kTukey, 1.0);
  ways.push_back({"equal weights", {}});
  CalibrateOptions& paper = ways.back().options;
  paper.solver = Solver::kLinearized;
  paper.start = Start::kClosedForm;
  paper.linearized.error = LinearizedOptions::Error::kPaper;
  paper.linearized.max_iterations = 60;
  paper.linearized.tolerance = 1e-10;
  return ways;
}

// Of as many, in %, with the binomial standard error.
std::string Share(int count, int of) {
  const double share = static_cast<double>(count) / of;
  return fmt::format(
      "{:.2f} ± {:.2f}", 100.0 * share, 100.0 * std::sqrt(share * (1.0 - share) / of));
}

// The noise is so many times as large as it is stated.
GlobalTest TestOfNoise(Random& rng, int poses, double times, const CalibrateOptions& options) {
  const Matrix6d noise = testing::TrackerLikeCovariance();
  const BaseAndTool truth = {testing::SmallPose(rng, 0.1, 0.1), testing::SmallPose(rng, 0.1, 0.2)};
  std::vector<Observation> rows = testing::HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, times * times * noise, &rows);
  return GlobalTestOf(Calibrate(testing::KnownNoise(rows, noise), {}, options));
}

void PrintGoodnessOfFit(int draws) {
  fmt::print(
      "| fit | within the 95 % limits, 24 poses, % | noise understated by 15 % found, 60 poses, % "
      "|\n| --- | --- | --- |\n");
  for (const Way& way : Ways()) {
    Random rng(1);  // of the same datasets each
    int held = 0, found = 0;
    for (int k = 0; k < draws; ++k) {
      const GlobalTest clean = TestOfNoise(rng, 24, 1.0, way.options);
      held += !clean.is_too_large && !clean.is_too_small;
      found += TestOfNoise(rng, 60, 1.0 / 0.85, way.options).is_too_large;
    }
    fmt::print("| {} | {} | {} |\n", way.name, Share(held, draws), Share(found, draws));
  }
}

struct Searched {
  Observations observations;
  ReadingSearch search;
};

Searched Search(const Dataset& dataset, const MarkerTruth& truth) {
  Searched all = {MakeObservations(dataset), {}};
  all.search =
      FindBadReadings(MakeMarkerObservations(dataset, all.observations), truth.mounts, {}, {});
  return all;
}

void PrintFalseAlarms(int draws) {
  fmt::print(
      "\n| clean readings | sigma stated: a reading is named, % | not stated, % |\n"
      "| --- | --- | --- |\n");
  std::vector<std::pair<const char*, MarkerScene>> scenes = {
      {"two rigid bodies", {}}, {"static tracker", {}}, {"centroid", {}}, {"robot noise", {}}};
  scenes[1].second.tracker_is_static = true;
  scenes[2].second.centroid = {false, true};
  scenes[3].second.robot_noise = 5e-5;
  int all = 0;
  for (const auto& [name, scene] : scenes) {
    Random rng(2);
    const MarkerTruth truth = testing::MakeMarkerTruth(rng, scene);
    int alarms[2] = {0, 0};
    for (int k = 0; k < 2 * draws; ++k) {
      Dataset dataset = testing::DrawMarkers(truth, rng());
      if (k % 2 == 1) dataset.measurement->marker_sigma.reset();
      alarms[k % 2] += !Search(dataset, truth).search.Bad().empty();
    }
    all += alarms[0] + alarms[1];
    fmt::print("| {} | {} | {} |\n", name, Share(alarms[0], draws), Share(alarms[1], draws));
  }
  fmt::print("\nall together: {} %\n", Share(all, static_cast<int>(2 * scenes.size()) * draws));
}

// An error of the smallest size that is stated to be found, in any direction.
void PrintPower(int draws) {
  Random rng(3);
  MarkerScene scene;
  scene.sigma.setConstant(1e-4);
  const MarkerTruth truth = testing::MakeMarkerTruth(rng, scene);
  int found = 0, others = 0;
  for (int k = 0; k < draws; ++k) {
    Dataset dataset = testing::DrawMarkers(truth, rng());
    const Searched clean = Search(dataset, truth);
    const ReadingCheck& chosen = clean.search.checks[rng() % clean.search.checks.size()];
    const std::string& label = clean.observations.items[chosen.item].label;
    const Eigen::Vector3d direction = testing::Normal(rng, 3).normalized();
    for (MarkerReading& r : dataset.measurement->readings) {
      const auto body = static_cast<std::size_t>(r.body);
      const std::string marker =
          (body == 0 ? "base/" : "tool/") +
          dataset.measurement->bodies[body].markers[static_cast<std::size_t>(r.marker)];
      if (dataset.robot_poses.rows[static_cast<std::size_t>(r.pose)].label == label &&
          marker == chosen.marker)
        r.p_in_tracker += chosen.smallest * direction;
    }
    const auto is_it = [&](const ReadingCheck& one) {
      return one.item == chosen.item && one.marker == chosen.marker;
    };
    const std::vector<ReadingCheck> bad = Search(dataset, truth).search.Bad();
    found += std::any_of(bad.begin(), bad.end(), is_it);
    others += !std::all_of(bad.begin(), bad.end(), is_it);
  }
  fmt::print("\nan error of the smallest size: found in {} %, another reading named in {} %\n",
             Share(found, draws),
             Share(others, draws));
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  const int draws = std::max(1, argc > 1 ? std::atoi(argv[1]) : 500);
  hexcal::PrintGoodnessOfFit(draws);
  hexcal::PrintFalseAlarms(draws);
  hexcal::PrintPower(draws);
  return 0;
}
