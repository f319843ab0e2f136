// SPDX-License-Identifier: BSD-3-Clause
// Calibration by the likelihood of marker readings: truth, noise level, residuals by marker, and
// the covariance against repeats.
#include "estimator/calibrate_markers.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "testing/marker_scenes.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::DrawMarkers;
using testing::MakeMarkerTruth;
using testing::MarkerScene;
using testing::MarkerTruth;
using testing::SeededByTest;

Estimate CalibrateByMarkers(const Dataset& dataset) {
  const Observations observations = MakeObservations(dataset);
  return CalibrateMarkers(observations, MakeMarkerObservations(dataset, observations), {}, {});
}

MarkerScene Scene(bool tracker_is_static, bool centroid, double robot_noise) {
  MarkerScene scene;
  scene.tracker_is_static = tracker_is_static;
  scene.centroid = {centroid, centroid};
  scene.robot_noise = robot_noise;
  return scene;
}

std::vector<MarkerScene> Scenes() {
  std::vector<MarkerScene> scenes;
  for (const bool is_static : {false, true})
    for (const bool centroid : {false, true})
      for (const double robot_noise : {0.0, 1e-4})
        scenes.push_back(Scene(is_static, centroid, robot_noise));
  return scenes;
}

TEST(CalibrateMarkers, RecoversTheTruthWithoutNoise) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : Scenes())
    for (const bool is_stated : {true, false}) {
      const MarkerTruth truth = MakeMarkerTruth(rng, scene);
      Dataset dataset = DrawMarkers(truth, 1, 0.0);
      if (!is_stated) dataset.measurement->marker_sigma.reset();
      const Estimate e = CalibrateByMarkers(dataset);
      EXPECT_TRUE(e.converged) << e.message;
      EXPECT_TRUE(e.IsTrustworthy());
      EXPECT_LT(Difference(e.mounts, truth.mounts).cwiseAbs().maxCoeff(), 1e-11);
      if (scene.tracker_is_static) {
        EXPECT_TRUE(testing::PoseNear(
            *e.tracker_from_world, *truth.dataset.tracker.tracker_from_world, 1e-11, 1e-11));
      }
    }
}

// One residual block a reading, all nuisances as parameters: the same estimate.
TEST(CalibrateMarkers, ByItsReferenceIsTheSame) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : Scenes())
    for (const bool is_stated : {true, false}) {
      Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, scene), 1);
      if (!is_stated) dataset.measurement->marker_sigma.reset();
      const Observations observations = MakeObservations(dataset);
      CalibrateOptions options;
      options.evaluation = Evaluation::kPerPose;
      const Estimate reference = CalibrateMarkers(
          observations, MakeMarkerObservations(dataset, observations), {}, options);
      const Estimate e = CalibrateByMarkers(dataset);
      EXPECT_TRUE(reference.converged);
      const Vector12d sigma = e.covariance.diagonal().cwiseSqrt();
      const Vector12d apart = Difference(e.mounts, reference.mounts);
      EXPECT_LT(apart.cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT(apart.cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_TRUE(
          testing::MatrixNear(*e.noise.marker, *reference.noise.marker, 1e-8 * sigma.maxCoeff()));
      EXPECT_NEAR(e.chi_square / reference.chi_square, 1.0, 1e-8);
    }
}

TEST(CalibrateMarkers, GivesIntervalsByTheNoisesDegreesOfFreedom) {
  auto rng = SeededByTest();
  Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, Scene(false, false, 0.0)), 1);
  const Estimate known = CalibrateByMarkers(dataset);
  EXPECT_NEAR(known.intervals.half_width[4] / std::sqrt(known.covariance(4, 4)), 1.95996, 1e-4);
  EXPECT_NEAR(known.intervals.ellipsoid, 21.02607, 1e-4);  // chi-square, 12
  dataset.measurement->marker_sigma.reset();
  const Estimate e = CalibrateByMarkers(dataset);
  EXPECT_EQ(e.intervals.degrees_of_freedom[4], e.degrees_of_freedom);
  EXPECT_GT(e.intervals.half_width[4] / std::sqrt(e.covariance(4, 4)), 1.965);
  EXPECT_GT(e.intervals.ellipsoid, 21.1);
}

// Repeats: reported standard deviations, all 12 together, those of the base (which a static
// tracker's common error moves), and chi-square.
struct Repeats {
  Vector12d squared = Vector12d::Zero(), variance = Vector12d::Zero();
  double of_all = 0.0, of_base = 0.0, chi_square = 0.0;
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();  // root of the mean square
};

Repeats Repeat(const MarkerTruth& truth, bool is_stated, int draws) {
  Repeats r;
  for (int i = 0; i < draws; ++i) {
    Dataset dataset = DrawMarkers(truth, static_cast<std::uint64_t>(i));
    if (!is_stated) dataset.measurement->marker_sigma.reset();
    const Estimate e = CalibrateByMarkers(dataset);
    EXPECT_TRUE(e.IsTrustworthy());
    EXPECT_EQ(e.noise.estimated, !is_stated);
    const Vector12d d = Difference(e.mounts, truth.mounts);
    r.squared += d.cwiseAbs2() / draws;
    r.variance += e.covariance.diagonal() / draws;
    r.of_all += d.dot(e.covariance.ldlt().solve(d)) / draws;
    const Matrix6d base = e.covariance.topLeftCorner<6, 6>();
    r.of_base += d.head<6>().dot(base.ldlt().solve(d.head<6>())) / draws;
    r.chi_square += e.chi_square / e.degrees_of_freedom / draws;
    r.sigma += e.noise.marker->cwiseAbs2() / draws;
  }
  r.sigma = r.sigma.cwiseSqrt();
  return r;
}

constexpr int kDraws = 400;

void ExpectReportedSpread(const MarkerScene& scene) {
  auto rng = SeededByTest();
  const Repeats r = Repeat(MakeMarkerTruth(rng, scene), true, kDraws);
  // Five standard deviations of each mean, 3.7 of the single sigmas.
  EXPECT_NEAR(r.of_all, 12.0, 5.0 * std::sqrt(24.0 / kDraws));
  EXPECT_NEAR(r.of_base, 6.0, 5.0 * std::sqrt(12.0 / kDraws));
  EXPECT_NEAR(r.chi_square, 1.0, 0.05);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(r.squared[i] / r.variance[i]), 1.0, 0.13) << kParameters[i].name;
}

TEST(CalibrateMarkers, SpreadsAsReportedMovingRigid) {
  ExpectReportedSpread(Scene(false, false, 0.0));
}
TEST(CalibrateMarkers, SpreadsAsReportedMovingCentroid) {
  ExpectReportedSpread(Scene(false, true, 0.0));
}
TEST(CalibrateMarkers, SpreadsAsReportedStaticRigid) {
  ExpectReportedSpread(Scene(true, false, 0.0));
}
TEST(CalibrateMarkers, SpreadsAsReportedStaticCentroid) {
  ExpectReportedSpread(Scene(true, true, 0.0));
}
TEST(CalibrateMarkers, SpreadsAsReportedMovingNoisyRobot) {
  ExpectReportedSpread(Scene(false, false, 1e-4));
}
TEST(CalibrateMarkers, SpreadsAsReportedStaticNoisyRobot) {
  ExpectReportedSpread(Scene(true, true, 1e-4));
}

// A sigma that is not stated: the estimate has no bias, with a noisy robot too.
TEST(CalibrateMarkers, FindsTheNoiseLevel) {
  auto rng = SeededByTest();
  for (const double robot_noise : {0.0, 1e-4}) {
    MarkerScene scene = Scene(false, false, robot_noise);
    scene.sigma.setConstant(2e-4);
    scene.frames = 1;
    const Repeats r = Repeat(MakeMarkerTruth(rng, scene), false, 150);
    EXPECT_NEAR(r.sigma.x() / 2e-4, 1.0, 0.02);
    EXPECT_EQ(r.sigma.x(), r.sigma.z());
    EXPECT_NEAR(r.chi_square, 1.0, robot_noise > 0 ? 0.02 : 1e-6);
  }
}

// Repeated frames tell one axis from another.
TEST(CalibrateMarkers, TakesTheRatiosOfTheAxesFromRepeatedFrames) {
  auto rng = SeededByTest();
  MarkerScene scene = Scene(false, false, 0.0);
  scene.frames = 6;
  const MarkerTruth truth = MakeMarkerTruth(rng, scene);
  const Repeats estimated = Repeat(truth, false, 200), stated = Repeat(truth, true, 200);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(estimated.sigma[axis] / scene.sigma[axis], 1.0, 0.02);
  // Little is lost against the true sigmas.
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(estimated.squared[i] / stated.squared[i], 1.0, 0.05) << kParameters[i].name;
}

TEST(CalibrateMarkers, SaysWhereTheModelMissesWhatFramesDoNot) {
  auto rng = SeededByTest();
  MarkerScene scene = Scene(false, false, 0.0);
  scene.frames = 6;
  scene.sigma.setConstant(1e-4);
  Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, scene), 1);
  dataset.measurement->marker_sigma.reset();
  EXPECT_TRUE(CalibrateByMarkers(dataset).warnings.empty());
  dataset.measurement->bodies[1].p_in_body(2, 3) += 2e-3;
  const Estimate e = CalibrateByMarkers(dataset);
  ASSERT_EQ(e.warnings.size(), 1u);
  EXPECT_NE(e.warnings[0].find("the model misses something"), std::string::npos);
  EXPECT_GT(e.noise.marker->x(), 2e-4);
}

TEST(CalibrateMarkers, ListsWhatIsLeftOfEveryMarkerSeen) {
  auto rng = SeededByTest();
  for (const bool is_static : {false, true}) {
    MarkerScene scene = Scene(is_static, false, 0.0);
    scene.frames = 1;
    scene.poses = 20;
    scene.sigma.setConstant(1e-4);
    const MarkerTruth truth = MakeMarkerTruth(rng, scene);
    Dataset dataset = DrawMarkers(truth, 1, 0.0);
    // One reading is off; in the others there is no noise.
    const Eigen::Vector3d off(1e-3, -2e-3, 0.5e-3);
    for (MarkerReading& r : dataset.measurement->readings)
      if (r.pose == 3 && r.body == BodyId::kTool && r.marker == 1) r.p_in_tracker += off;
    const Estimate e = CalibrateByMarkers(dataset);
    ASSERT_EQ(e.poses.size(), 20u);
    const auto& third = e.poses[3];
    EXPECT_EQ(third.label, "p4");
    // Marker t4 (pose 3, frame 0) is hidden, and so is the base under a static tracker.
    std::vector<std::string> labels;
    for (const MarkerMisfit& m : third.markers) labels.push_back(m.marker);
    const std::vector<std::string> tool = {"tool/t1", "tool/t2", "tool/t3"};
    const std::vector<std::string> all = {
        "base/b1", "base/b2", "base/b3", "tool/t1", "tool/t2", "tool/t3"};
    EXPECT_EQ(labels, is_static ? tool : all);
    const Eigen::Vector3d left = third.markers[is_static ? 1 : 4].residual;
    EXPECT_GT(left.dot(off), 0.25 * off.squaredNorm());
    for (const PoseResult& pose : e.poses) {
      for (const MarkerMisfit& m : pose.markers) EXPECT_LE(m.residual.norm(), left.norm());
    }
  }
}

// By poses and by markers are the same to first order where all shapes are known.
TEST(CalibrateMarkers, OfRigidBodiesIsThatByPosesToFirstOrder) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : Scenes()) {
    if (scene.centroid[0]) continue;
    const Dataset dataset = DrawMarkers(MakeMarkerTruth(rng, scene), 1);
    const Estimate by_markers = CalibrateByMarkers(dataset);
    const Estimate by_poses = Calibrate(MakeObservations(dataset), {}, {});
    const Vector12d sigma = by_markers.covariance.diagonal().cwiseSqrt();
    const Vector12d other = by_poses.covariance.diagonal().cwiseSqrt();
    const Vector12d apart = Difference(by_markers.mounts, by_poses.mounts).cwiseQuotient(sigma);
    EXPECT_LT(apart.cwiseAbs().maxCoeff(), 0.05);
    EXPECT_TRUE(
        testing::MatrixNear(Vector12d(other.cwiseQuotient(sigma)), Vector12d::Ones(), 0.01));
    EXPECT_NEAR(by_markers.noise.position / by_poses.noise.position, 1.0, 0.01);
    EXPECT_NEAR(by_markers.noise.orientation / by_poses.noise.orientation, 1.0, 0.01);
    EXPECT_EQ(by_markers.noise.assumed, by_poses.noise.assumed);
  }
}

// The pose of a centroid body knows nothing of the same body's shape in the other poses; the
// readings together do. What they differ by has the variance that the better one saves.
TEST(CalibrateMarkers, OfCentroidBodiesIsBetterThanByPoses) {
  auto rng = SeededByTest();
  const MarkerTruth truth = MakeMarkerTruth(rng, Scene(false, true, 0.0));
  const int draws = 200;
  Vector12d squared = Vector12d::Zero(), saved = Vector12d::Zero(), gain = Vector12d::Zero();
  for (int i = 0; i < draws; ++i) {
    const Dataset dataset = DrawMarkers(truth, static_cast<std::uint64_t>(i));
    const Estimate by_markers = CalibrateByMarkers(dataset);
    const Estimate by_poses = Calibrate(MakeObservations(dataset), {}, {});
    squared += Difference(by_markers.mounts, by_poses.mounts).cwiseAbs2() / draws;
    const Vector12d variance = by_markers.covariance.diagonal();
    const Vector12d other = by_poses.covariance.diagonal();
    saved += (other - variance) / draws;
    gain += other.cwiseQuotient(variance) / draws;
  }
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(squared[i] / saved[i]), 1.0, 0.2) << kParameters[i].name;
  EXPECT_GT(gain.maxCoeff(), 1.5);
  EXPECT_GT(gain.minCoeff(), 1.0);
}

// A pose whose tool was moved: out of the fit, with what is left of its markers.
TEST(CalibrateMarkers, LeavesOutliersOut) {
  auto rng = SeededByTest();
  for (const bool is_static : {false, true}) {
    MarkerScene scene = Scene(is_static, false, 0.0);
    scene.poses = 30;
    const MarkerTruth truth = MakeMarkerTruth(rng, scene);
    const Dataset clean = DrawMarkers(truth, 1);
    Dataset spoilt = clean, without = clean;
    for (MarkerReading& r : spoilt.measurement->readings)
      if (r.pose == 7 && r.body == BodyId::kTool) r.p_in_tracker.x() += 0.05;
    auto& readings = without.measurement->readings;
    readings.erase(std::remove_if(readings.begin(),
                                  readings.end(),
                                  [](const MarkerReading& r) {
                                    return r.pose == 7 && r.body == BodyId::kTool;
                                  }),
                   readings.end());
    CalibrateOptions options;
    options.outliers = OutlierHandling::kReject;
    const Observations observations = MakeObservations(spoilt);
    const Estimate e =
        CalibrateMarkers(observations, MakeMarkerObservations(spoilt, observations), {}, options);
    const Estimate expected = CalibrateByMarkers(without);
    ASSERT_EQ(e.outliers.size(), 1u);
    EXPECT_EQ(e.outliers[0].label, "p8");
    EXPECT_LT(Difference(e.mounts, expected.mounts).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE(testing::MatrixNear(e.covariance, expected.covariance, 1e-16));
    EXPECT_EQ(e.degrees_of_freedom, expected.degrees_of_freedom);
    ASSERT_EQ(e.poses.size(), 30u);
    EXPECT_EQ(e.poses[7].weight, 0.0);
    ASSERT_FALSE(e.poses[7].markers.empty());
    double largest = 0.0;
    for (const MarkerMisfit& m : e.poses[7].markers) largest = std::max(largest, m.residual.norm());
    // A tracker that may turn takes most of a shift 2 m away as its own turn.
    EXPECT_GT(largest, is_static ? 0.03 : 0.003);
    EXPECT_EQ(e.poses[8].markers.back().residual, expected.poses[7].markers.back().residual);
    options.outliers = OutlierHandling::kKeep;
    const Estimate kept =
        CalibrateMarkers(observations, MakeMarkerObservations(spoilt, observations), {}, options);
    ASSERT_EQ(kept.outliers.size(), 1u);
    EXPECT_EQ(kept.poses[7].weight, 1.0);
  }
}

TEST(CalibrateMarkers, SaysWhichSideTheNoiseIsOn) {
  auto rng = SeededByTest();
  MarkerScene scene = Scene(false, false, 0.0);
  const auto side = [&] {
    return CalibrateByMarkers(DrawMarkers(MakeMarkerTruth(rng, scene), 1)).noise.assumed;
  };
  EXPECT_EQ(side(), NoiseSide::kTracker);
  scene.robot_noise = 1e-4;
  EXPECT_EQ(side(), NoiseSide::kBoth);
  scene.sigma.setConstant(1e-9);
  EXPECT_EQ(side(), NoiseSide::kRobot);
}

}  // namespace
}  // namespace hexcal
