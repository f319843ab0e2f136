// SPDX-License-Identifier: BSD-3-Clause
// What a screening says of an effect is of the directions that the data tell, without a prior.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "discovery/screening.h"
#include "discovery/told_part.h"
#include "testing/model_scene.h"

namespace hexcal {
namespace {

using ::testing::SizeIs;

constexpr double kPlausible = 1e-4;  // m, of a marker's offset

// Three markers a body, all in its plane z = 0; marker b3 is off by this, frame of the body.
Screening ScreenPlaneBodies(const Eigen::Vector3d& offset, std::uint64_t seed) {
  auto rng = testing::SeededByTest();
  testing::ModelScene scene = testing::MakeModelScene(rng, {}, 40);
  std::array<MarkerBody, 2>& bodies = scene.plan.measurement->bodies;
  bodies[0].markers = {"b1", "b2", "b3"};
  bodies[0].p_in_body.resize(3, 3);
  bodies[0].p_in_body << -0.2, 0.2, 0.0, -0.1, -0.1, 0.25, 0, 0, 0;
  bodies[1].markers = {"t1", "t2", "t3"};
  bodies[1].p_in_body.resize(3, 3);
  bodies[1].p_in_body << -0.1, 0.1, 0.0, -0.1, -0.1, 0.12, 0, 0, 0;
  if (!offset.isZero()) {
    Effect effect;
    effect.name = "marker_offset";
    effect.index = {3};
    effect.parameters = offset;
    const std::vector<Visit> visits =
        MakeVisits(scene.plan, &*scene.plan.hexapod, ReportedPoses(scene.plan));
    effect.reference = ReferenceFor(*FindEffectKind("marker_offset"), visits, scene.plan);
    scene.truth.effects.push_back(effect);
  }
  DiscoverOptions options;
  options.bootstraps = 199;
  return Screen(Simulate(scene.plan, scene.truth, {seed, 1.0, true}), options, {scene.p_in_tool});
}

const Hypothesis& OffsetIn(const Screening& screening) {
  for (const Hypothesis& one : screening.tested)
    if (one.name == "marker_offset") return one;
  ADD_FAILURE() << "not tested";
  return screening.tested.front();
}

// Out of its plane a marker turns the body, and base or tool take that: nothing tells it.
TEST(ScreeningTold, OutOfItsPlaneAMarkerIsNotTestable) {
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 2e-4)}) {
    const Screening screening = ScreenPlaneBodies(offset, 4);
    EXPECT_THAT(screening.named, SizeIs(0));
    const Hypothesis& found = OffsetIn(screening);
    EXPECT_EQ(found.directions, 3);
    EXPECT_EQ(found.told, 2);
    EXPECT_LT(std::abs(found.size), 0.3 * kPlausible);
    EXPECT_LT(found.standard_uncertainty, 0.3 * kPlausible);
    EXPECT_LT(found.at_points.at(0) + found.at_points_uncertainty.at(0), 1e-4);
  }
}

TEST(ScreeningTold, InItsPlaneAMarkersOffsetIsFound) {
  for (const Eigen::Vector3d& offset : {Eigen::Vector3d(2e-4, 0, 0), Eigen::Vector3d(0, -2e-4, 0)})
    for (const std::uint64_t seed : {7, 8, 9}) {
      const Screening screening = ScreenPlaneBodies(offset, seed);
      ASSERT_THAT(screening.named, SizeIs(1));
      const Hypothesis& found = screening.tested.front();
      EXPECT_EQ(found.name, "marker_offset");
      EXPECT_EQ(found.told, 2);
      EXPECT_NEAR(found.size, offset.sum(), 3.0 * found.standard_uncertainty);
      EXPECT_LT(found.standard_uncertainty, 0.1 * std::abs(offset.sum()));
    }
}

// One number well told (data alone: 2 with a variance of 0.01), one hardly (5, 100), in units of a
// prior of 1; one mount, which takes half of the first. By hand: posterior = data's precision
// and 1.
TEST(ToldPart, TakesThePriorOutAndLeavesWhatIsNotTold) {
  const Eigen::Vector2d prior(1e-3, 4.0);
  JointFit fit;
  fit.mounts = Eigen::VectorXd::Zero(1);
  const double first = 1.0 / (100.0 + 1.0), second = 1.0 / (0.01 + 1.0);
  fit.coefficients = prior.cwiseProduct(Eigen::Vector2d(2.0 * 100.0 * first, 5.0 * 0.01 * second));
  fit.covariance = Eigen::MatrixXd::Zero(3, 3);
  fit.covariance(1, 1) = first * prior[0] * prior[0];
  fit.covariance(2, 2) = second * prior[1] * prior[1];
  fit.covariance(0, 1) = fit.covariance(1, 0) = -0.5 * fit.covariance(1, 1);
  const ToldPart part = ToldPartOf(fit, prior, 0);
  EXPECT_EQ(part.directions, 2);
  EXPECT_EQ(part.told, 1);
  EXPECT_NEAR(part.coefficients[0], 2.0e-3, 1e-12);
  EXPECT_EQ(part.coefficients[1], 0.0);
  EXPECT_NEAR(part.StandardUncertainty(0), 0.1e-3, 1e-12);
  EXPECT_EQ(part.StandardUncertainty(1), 0.0);
  EXPECT_NEAR(part.response(0, 0), -0.5, 1e-12);
  EXPECT_NEAR(part.response(0, 1), 0.0, 1e-12);

  const ToldPart both = ToldPartOf(fit, prior, 2);
  EXPECT_EQ(both.told, 2);
  EXPECT_NEAR(both.coefficients[1], 5.0 * prior[1], 1e-9);
  EXPECT_NEAR(both.StandardUncertainty(1), 10.0 * prior[1], 1e-9);
}

}  // namespace
}  // namespace hexcal
