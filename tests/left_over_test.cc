// SPDX-License-Identifier: BSD-3-Clause
#include "report/left_over.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "estimator/calibrate_markers.h"
#include "report/calibrate_html.h"
#include "report/marker_charts.h"
#include "report/scene.h"
#include "testing/marker_scenes.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::DrawMarkers;
using ::hexcal::testing::MakeMarkerTruth;
using ::hexcal::testing::MarkerScene;
using ::hexcal::testing::MarkerTruth;
using ::hexcal::testing::SeededByTest;

struct Found {
  Estimate estimate;
  LeftOver left;
};

Found FindLeftOver(const Dataset& dataset) {
  const Observations observations = MakeObservations(dataset);
  const MarkerObservations markers = MakeMarkerObservations(dataset, observations);
  Found found;
  found.estimate = CalibrateMarkers(observations, markers, {}, {});
  found.left = MakeLeftOver(dataset, observations, found.estimate);
  return found;
}

// Together they are the degrees of freedom of the fit.
TEST(LeftOver, ExpectationsAddUpToTheDegreesOfFreedom) {
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.sigma = Eigen::Vector3d::Constant(1e-4);
  scene.frames = 1;
  for (const bool is_static : {false, true}) {
    scene.tracker_is_static = is_static;
    const Found found = FindLeftOver(DrawMarkers(MakeMarkerTruth(rng, scene), 1));
    double sum = 0.0;
    for (const MarkerLeftOver& marker : found.left.markers)
      sum += 3.0 * marker.poses * std::pow(marker.expected / 1e-4, 2);
    EXPECT_NEAR(sum, found.estimate.degrees_of_freedom, 0.02 * sum);
  }
}

TEST(LeftOver, RmsIsThatOfTheMarkersResiduals) {
  auto rng = SeededByTest();
  const Found found = FindLeftOver(DrawMarkers(MakeMarkerTruth(rng, {}), 1));
  ASSERT_EQ(found.left.markers.size(), 8u);
  EXPECT_EQ(found.left.markers[0].label.substr(0, 5), "base/");
  double squares = 0.0, by_marker = 0.0;
  for (const PoseResult& pose : found.estimate.poses)
    for (const MarkerMisfit& misfit : pose.markers) squares += misfit.residual.squaredNorm();
  for (const MarkerLeftOver& marker : found.left.markers) {
    EXPECT_EQ(marker.residuals.size(), static_cast<std::size_t>(marker.poses));
    by_marker += 3.0 * marker.poses * marker.rms * marker.rms;
  }
  EXPECT_NEAR(by_marker, squares, 1e-12 * squares);
  EXPECT_TRUE(found.left.poses.times.empty());
}

// The residuals of a pose that was left out are shown, but in no figure: a kilometre would show.
TEST(LeftOver, AMarkersFiguresAreWithoutRejectedPoses) {
  auto rng = SeededByTest();
  const Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, {}), 1);
  const Observations observations = MakeObservations(dataset);
  Estimate estimate =
      CalibrateMarkers(observations, MakeMarkerObservations(dataset, observations), {}, {});
  estimate.poses[3].weight = 0.0;
  for (MarkerMisfit& misfit : estimate.poses[3].markers) misfit.residual.setConstant(1e3);
  const LeftOver left = MakeLeftOver(dataset, observations, estimate);
  for (const MarkerLeftOver& marker : left.markers) {
    EXPECT_LT(marker.rms, 1e-2) << marker.label;
    for (std::size_t k = 0; k < marker.used.size(); ++k)
      EXPECT_EQ(marker.used[k], marker.pose_of_residual[k] != 3) << marker.label;
  }
  HtmlPage page("calibrate", "", "");
  AddMarkers(left, &page);
  EXPECT_NE(page.Html().find("A thin cross is of a pose that was left out"), std::string::npos);
  const std::regex large("<td class=\"number\">-?[0-9]{3,}\\.");  // mm, of a mean or an RMS
  EXPECT_FALSE(std::regex_search(page.Html(), large));
}

// What is expected of each marker is what repetition finds: hidden markers, three frames a pose and
// unequal axes included.
void ExpectAgreesWithRepetition(const MarkerScene& scene, double tolerance) {
  auto rng = SeededByTest();
  const MarkerTruth truth = MakeMarkerTruth(rng, scene);
  constexpr int kDraws = 1500;
  std::vector<double> found(8), expected(8);
  for (int draw = 0; draw < kDraws; ++draw) {
    const LeftOver left = FindLeftOver(DrawMarkers(truth, 100 + draw)).left;
    ASSERT_EQ(left.markers.size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
      found[k] += left.markers[k].rms * left.markers[k].rms / kDraws;
      expected[k] += left.markers[k].expected * left.markers[k].expected / kDraws;
    }
  }
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(std::sqrt(found[k] / expected[k]), 1.0, tolerance) << k;
}

TEST(LeftOver, ExpectationAgreesWithRepetition) { ExpectAgreesWithRepetition({}, 0.03); }

TEST(LeftOver, ExpectationAgreesWithRepetitionUnderAStaticTracker) {
  MarkerScene scene;
  scene.tracker_is_static = true;
  ExpectAgreesWithRepetition(scene, 0.03);
}

// Sixty poses of three frames with times and every marker: the page stays below 8 MB.
TEST(LeftOver, AReportOfSixtyPosesStaysLight) {
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.poses = 60;
  const Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, scene), 1);
  Found found = FindLeftOver(dataset);
  for (std::size_t i = 0; i < found.estimate.poses.size(); ++i)
    found.left.poses.times.push_back(60.0 * static_cast<double>(i));
  const std::string html =
      CalibrateHtml({"demo", "nonlinear", "marker", ""},
                    {},
                    found.estimate,
                    FrameGraphOf(dataset, {}),
                    MakeScene(dataset, MakeObservations(dataset), found.estimate),
                    found.left);
  EXPECT_LT(html.size(), std::size_t{8} << 20);
  for (const char* picture : {"Position residuals in order of visit",
                              "Orientation residuals over time",
                              "What is left over by marker",
                              "Residuals of each marker"})
    EXPECT_NE(html.find(std::string("<h3>") + picture), std::string::npos) << picture;
}

// In a plane body of four the others share the misfit of one that is off the plane.
TEST(LeftOver, ABodyOfAnotherShapeStandsOut) {
  auto rng = SeededByTest();
  Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, {}), 1);
  dataset.measurement->bodies[1].p_in_body(2, 1) += 2e-3;
  double of_base = 0.0, of_tool = 0.0;
  for (const MarkerLeftOver& marker : FindLeftOver(dataset).left.markers) {
    double& largest = marker.label[0] == 'b' ? of_base : of_tool;
    largest = std::max(largest, marker.rms / marker.expected);
  }
  EXPECT_GT(of_tool, 2.0);
  EXPECT_GT(of_tool, 1.5 * of_base);
}

TEST(LeftOver, TimesAreThoseOfThePoses) {
  auto rng = SeededByTest();
  Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, {}), 1);
  Covariate time{"time", *FindCovariateUnit("s"), {}};
  for (std::size_t i = 0; i < dataset.robot_poses.rows.size(); ++i)
    time.values.push_back(10.0 * static_cast<double>(i));
  dataset.robot_poses.covariates.push_back(time);
  const Found found = FindLeftOver(dataset);
  ASSERT_EQ(found.left.poses.times.size(), found.estimate.poses.size());
  for (std::size_t i = 0; i < found.left.poses.times.size(); ++i) {
    const RobotPose& row =
        dataset.robot_poses.rows[static_cast<std::size_t>(found.left.poses.times[i] / 10.0)];
    EXPECT_EQ(row.label, found.estimate.poses[i].label);
  }
}

}  // namespace
}  // namespace hexcal
