// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/reading_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimator/calibrate_markers.h"
#include "estimator/marker_solver.h"
#include "estimator/quantiles.h"
#include "testing/marker_scenes.h"
#include "testing/matchers.h"
#include "testing/random.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::DrawMarkers;
using testing::MakeMarkerTruth;
using testing::MarkerScene;
using testing::MarkerTruth;
using testing::SeededByTest;

struct Searched {
  Observations observations;
  MarkerObservations markers;
  ReadingSearch search;
};

Searched Search(const Dataset& dataset, const MarkerTruth& truth) {
  Searched all;
  all.observations = MakeObservations(dataset);
  all.markers = MakeMarkerObservations(dataset, all.observations);
  all.search = FindBadReadings(all.markers, truth.mounts, {}, {});
  return all;
}

// All readings of one marker in one pose.
template <typename Change>
void ChangeReading(Dataset* dataset, int pose, int body, int marker, const Change& change) {
  for (MarkerReading& r : dataset->measurement->readings)
    if (static_cast<int>(r.pose) == pose && static_cast<int>(r.body) == body &&
        static_cast<int>(r.marker) == marker)
      change(&r);
}

std::vector<MarkerScene> Scenes() {
  std::vector<MarkerScene> scenes(4);
  scenes[1].tracker_is_static = true;
  scenes[2].centroid = {false, true};
  scenes[3].robot_noise = 5e-5;
  return scenes;
}

// Found by the formula is found by taking the reading away and fitting again.
TEST(ReadingCheck, HeldOutErrorIsThatOfAFitWithoutTheReading) {
  auto rng = SeededByTest();
  const MarkerTruth truth = MakeMarkerTruth(rng, {});
  const Searched all = Search(DrawMarkers(truth, 5, 0.01), truth);
  ASSERT_GT(all.search.checks.size(), 40u);
  const MarkerData& data = all.markers.data;
  for (const int pose : {0, 4}) {
    for (const int at : {data.poses[pose].first_base, data.poses[pose].end - 1}) {
      MarkerObservations without = all.markers;
      auto& readings = without.data.readings;
      readings.erase(readings.begin() + at);
      for (MarkerPose& p : without.data.poses)
        for (int* index : {&p.first_base, &p.first_tool, &p.end})
          if (*index > at) --*index;
      const MarkerSolution solution = SolveMarkers(without, truth.mounts, {});
      const MarkerBatch batch(without.data, solution.sigma);
      const MarkerFit fit = FitOf(batch, solution.blocks, Evaluate(batch, solution.blocks));
      const bool is_base = at < data.poses[pose].first_tool;
      Pose3d tracker_from_body = fit.tracker_from_world[pose];
      if (!is_base)
        tracker_from_body = tracker_from_body * solution.solution.mounts.world_from_base *
                            data.poses[pose].base_from_platform *
                            solution.solution.mounts.platform_from_tool;
      const MarkerMean& reading = data.readings[at];
      const Eigen::Vector3d p = data.bodies[is_base ? 0 : 1].p_in_body.col(reading.marker);
      const Eigen::Vector3d error = reading.p_in_tracker - tracker_from_body * p;
      const std::string marker = all.markers.labels[is_base ? 0 : 1][reading.marker];
      const auto check = std::find_if(
          all.search.checks.begin(), all.search.checks.end(), [&](const ReadingCheck& c) {
            return static_cast<int>(c.item) == all.markers.item_of_pose[pose] && c.marker == marker;
          });
      ASSERT_NE(check, all.search.checks.end());
      EXPECT_TRUE(testing::MatrixNear(check->held_out, error, 1e-9));
    }
  }
}

// Clean readings: three squared sigmas each, and a false alarm once in a hundred datasets; with
// redundancies that add up to the degrees of freedom.
TEST(ReadingCheck, CleanReadingsAreFoundBadOnceInAHundredDatasets) {
  constexpr int kDraws = 120;
  auto rng = SeededByTest();
  int alarms = 0, datasets = 0;
  for (const MarkerScene& scene : Scenes()) {
    const MarkerTruth truth = MakeMarkerTruth(rng, scene);
    double squared = 0.0, beyond = 0.0, count = 0.0, scaled = 0.0, scaled_count = 0.0;
    for (int k = 0; k < kDraws; ++k) {
      Dataset dataset = DrawMarkers(truth, rng());
      if (k % 2 == 1) dataset.measurement->marker_sigma.reset();
      const Searched all = Search(dataset, truth);
      alarms += !all.search.Bad().empty();
      ++datasets;
      if (k % 2 == 1) {
        EXPECT_EQ(all.search.basis, NoiseBasis::kScaled);
        for (const ReadingCheck& check : all.search.checks) scaled += check.squared;
        scaled_count += static_cast<double>(all.search.checks.size());
        continue;
      }
      double redundancy = 0.0;
      for (const ReadingCheck& check : all.search.checks) {
        squared += check.squared;
        beyond += check.squared > ChiSquareQuantile(0.95, 3.0);
        ++count;
        redundancy += 3.0 * check.redundancy;
      }
      if (!scene.tracker_is_static && scene.robot_noise == 0.0 && all.search.unchecked == 0) {
        EXPECT_NEAR(redundancy, all.markers.NumResiduals() - all.markers.NumParameters(), 1e-6);
      }
    }
    EXPECT_NEAR(squared / count, 3.0, 0.15) << count;
    EXPECT_NEAR(beyond / count, 0.05, 0.012) << count;
    // By a noise of some hundred degrees of freedom: 3 f / (f - 2) of Fisher's distribution.
    EXPECT_NEAR(scaled / scaled_count, 3.0, 0.15) << scaled_count;
  }
  EXPECT_LE(alarms, 0.01 * datasets + 4.0 * std::sqrt(0.01 * datasets));
}

// An error of the smallest size that is stated is found four times of five along the worst
// direction, more often along others, and it alone.
TEST(ReadingCheck, TheSmallestErrorIsFoundWithItsPower) {
  constexpr int kDraws = 200;
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.sigma.setConstant(1e-4);
  const MarkerTruth truth = MakeMarkerTruth(rng, scene);
  int found = 0, found_smaller = 0, others = 0, draws = 0;
  for (int k = 0; k < kDraws; ++k) {
    const Dataset clean = DrawMarkers(truth, rng());
    const Searched before = Search(clean, truth);
    const ReadingCheck& chosen = before.search.checks[rng() % before.search.checks.size()];
    const int body = chosen.marker.substr(0, 4) == "base" ? 0 : 1;
    const auto& labels = before.markers.labels[body];
    const int marker =
        static_cast<int>(std::find(labels.begin(), labels.end(), chosen.marker) - labels.begin());
    const std::string label = before.observations.items[chosen.item].label;
    const Eigen::Vector3d direction = testing::Normal(rng, 3).normalized();
    const auto is_found = [&](double size) {
      Dataset bad = clean;
      for (std::size_t pose = 0; pose < bad.robot_poses.rows.size(); ++pose)
        if (bad.robot_poses.rows[pose].label == label)
          ChangeReading(&bad, static_cast<int>(pose), body, marker, [&](MarkerReading* r) {
            r->p_in_tracker += size * direction;
          });
      const auto list = Search(bad, truth).search.Bad();
      for (const ReadingCheck& one : list)
        if (one.item != chosen.item || one.marker != chosen.marker) ++others;
      return std::any_of(list.begin(), list.end(), [&](const ReadingCheck& one) {
        return one.item == chosen.item && one.marker == chosen.marker;
      });
    };
    found += is_found(chosen.smallest);
    found_smaller += is_found(0.5 * chosen.smallest);
    ++draws;
  }
  EXPECT_GE(found, 0.8 * draws - 4.0 * std::sqrt(0.16 * draws));
  EXPECT_LT(found_smaller, 0.5 * draws);
  EXPECT_LT(others, 0.06 * draws);
}

// What the pose as a whole hides is named by the calibration, which goes on using it.
TEST(ReadingCheck, ACalibrationNamesTheReadingAndUsesIt) {
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.frames = 1;
  scene.poses = 30;
  scene.sigma.setConstant(1e-4);
  const MarkerTruth truth = MakeMarkerTruth(rng, scene);
  Dataset dataset = DrawMarkers(truth, 3);
  const MarkerReading chosen = dataset.measurement->readings[17];
  ChangeReading(&dataset,
                static_cast<int>(chosen.pose),
                static_cast<int>(chosen.body),
                static_cast<int>(chosen.marker),
                [](MarkerReading* r) { r->p_in_tracker.x() += 8e-4; });
  const Observations observations = MakeObservations(dataset);
  CalibrateOptions options;
  options.outliers = OutlierHandling::kKeep;
  const Estimate estimate =
      CalibrateMarkers(observations, MakeMarkerObservations(dataset, observations), {}, options);
  const std::string label = dataset.robot_poses.rows[chosen.pose].label;
  const std::string marker =
      dataset.measurement->bodies[static_cast<int>(chosen.body)].markers[chosen.marker];
  const auto named = std::find_if(
      estimate.warnings.begin(), estimate.warnings.end(), [&](const std::string& warning) {
        return warning.find("/" + marker + " in pose " + label + ":") != std::string::npos &&
               warning.find("is used all the same") != std::string::npos;
      });
  EXPECT_NE(named, estimate.warnings.end());
  for (const PoseResult& pose : estimate.poses) EXPECT_EQ(pose.weight, 1.0);
}

// A robot that stood elsewhere moves all markers of the tool: none of them is to blame.
TEST(ReadingCheck, ABadRobotPoseIsNoBadReading) {
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.poses = 24;
  const MarkerTruth truth = MakeMarkerTruth(rng, scene);
  for (int k = 0; k < 10; ++k) {
    Dataset dataset = DrawMarkers(truth, rng());
    Observations observations = MakeObservations(dataset);
    const NoiseLevels large = {3e-3, 3e-2};
    observations.items[5].base_from_platform =
        Plus(observations.items[5].base_from_platform,
             Vector6d(testing::Isotropic(large).diagonal().cwiseSqrt().cwiseProduct(
                 testing::Normal(rng, 6))));
    const auto outliers = FindOutliers(observations, std::nullopt, {}).outliers;
    ASSERT_TRUE(std::any_of(
        outliers.begin(), outliers.end(), [](const Outlier& o) { return o.index == 5; }));
    const ReadingSearch search =
        FindBadReadings(MakeMarkerObservations(dataset, observations), truth.mounts, outliers, {});
    EXPECT_GT(search.checks.size(), 100u);
    EXPECT_TRUE(search.Bad().empty()) << search.Bad()[0].marker;
  }
}

}  // namespace
}  // namespace hexcal
