// SPDX-License-Identifier: BSD-3-Clause
// The markers' noise along the tracker's axes, from bodies of known shape alone: against the truth,
// its own spread, and where it says nothing.
#include "estimator/axis_noise.h"

#include <cmath>

#include "testing/marker_scenes.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::DrawMarkers;
using testing::MakeMarkerTruth;
using testing::MarkerScene;
using testing::MarkerTruth;
using testing::SeededByTest;

MarkerScene Scene(const Eigen::Vector3d& sigma, int poses, int frames = 1) {
  MarkerScene scene;
  scene.sigma = sigma;
  scene.poses = poses;
  scene.frames = frames;
  return scene;
}

std::optional<AxisNoise> NoiseOf(const Dataset& dataset) {
  return NoiseWithinBodies(MakeMarkerObservations(dataset, MakeObservations(dataset)));
}

// Mean and spread of the logarithms of the variances over the true ones.
struct Repeats {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
  Eigen::Vector3d stated = Eigen::Vector3d::Zero();  // mean of what the spread says
  int differ = 0;
};

Repeats Repeat(const MarkerTruth& truth, int draws) {
  Repeats r;
  for (int i = 0; i < draws; ++i) {
    const auto noise = NoiseOf(DrawMarkers(truth, static_cast<std::uint64_t>(i)));
    if (!noise) {
      ADD_FAILURE() << "nothing was told";
      return r;
    }
    const Eigen::Vector3d off =
        2.0 * noise->sigma.cwiseQuotient(truth.scene.sigma).array().log().matrix();
    r.mean += off / draws;
    r.variance += off.cwiseAbs2() / draws;
    r.stated += noise->spread.diagonal() / draws;
    r.differ += noise->AxesDiffer();
  }
  return r;
}

TEST(AxisNoise, FindsTheSigmasAndHowWellTheyAreKnown) {
  auto rng = SeededByTest();
  for (const int frames : {1, 4}) {
    const Repeats r = Repeat(MakeMarkerTruth(rng, Scene({1e-4, 0.7e-4, 3e-4}, 30, frames)), 400);
    for (int a = 0; a < 3; ++a) {
      // ln of chi-square over nu has the mean -1 / nu, about minus half its variance.
      EXPECT_NEAR(r.mean[a], -0.5 * r.stated[a], 5.0 * std::sqrt(r.stated[a] / 400));
      EXPECT_NEAR(r.variance[a] / r.stated[a], 1.0, 0.4);
    }
    EXPECT_EQ(r.differ, 400);
  }
}

TEST(AxisNoise, CallsAxesAlikeThatAre) {
  auto rng = SeededByTest();
  const Repeats many =
      Repeat(MakeMarkerTruth(rng, Scene(Eigen::Vector3d::Constant(1e-4), 30)), 1000);
  EXPECT_LE(many.differ, 6);
  const Repeats few = Repeat(MakeMarkerTruth(rng, Scene(Eigen::Vector3d::Constant(1e-4), 5)), 1000);
  EXPECT_LE(few.differ, 12);
}

// Neither the machine nor one wrong reading is in it.
TEST(AxisNoise, IsOfTheReadingsAlone) {
  auto rng = SeededByTest();
  const MarkerTruth truth = MakeMarkerTruth(rng, Scene(Eigen::Vector3d::Constant(1e-4), 30));
  Dataset dataset = DrawMarkers(truth, 1);
  const auto clean = NoiseOf(dataset);
  for (RobotPose& row : dataset.robot_poses.rows) row.base_from_platform.translation.x() += 1e-3;
  const auto moved = NoiseOf(dataset);
  ASSERT_TRUE(clean && moved);
  EXPECT_TRUE(testing::MatrixNear(moved->sigma, clean->sigma, 1e-9));
  for (MarkerReading& r : dataset.measurement->readings)
    if (r.pose == 3 && r.body == BodyId::kTool && r.marker == 1) r.p_in_tracker.y() += 5e-3;
  const auto spoilt = NoiseOf(dataset);
  ASSERT_TRUE(spoilt);
  EXPECT_NEAR(spoilt->sigma.y() / clean->sigma.y(), 1.0, 0.05);
}

// The shape of a centroid body is not known: one frame leaves nothing over.
TEST(AxisNoise, SaysNothingOfWhatNothingTells) {
  auto rng = SeededByTest();
  MarkerScene scene = Scene(Eigen::Vector3d::Constant(1e-4), 30);
  scene.centroid = {true, true};
  EXPECT_FALSE(NoiseOf(DrawMarkers(MakeMarkerTruth(rng, scene), 1)));
  scene.frames = 4;
  EXPECT_TRUE(NoiseOf(DrawMarkers(MakeMarkerTruth(rng, scene), 1)));
}

}  // namespace
}  // namespace hexcal
