// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/screening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "testing/model_scene.h"

namespace hexcal {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

DiscoverOptions Quick() {
  DiscoverOptions options;
  options.bootstraps = 199;
  return options;
}

struct Measured {
  testing::ModelScene scene;
  Dataset dataset;
};

Measured Measure(const std::vector<std::string>& effects, std::uint64_t seed, double noise = 1.0) {
  auto rng = testing::SeededByTest();
  Measured measured{testing::MakeModelScene(rng, effects, 60), {}};
  for (Machine* machine : {&measured.scene.truth, &measured.scene.model})
    for (Effect& effect : machine->effects) effect.parameters *= 4.0;  // to be clear in the noise
  measured.dataset = Simulate(measured.scene.plan, measured.scene.truth, {seed, noise, true});
  return measured;
}

// Against the exact joint fit, by other code: the effect's size, the fall of chi-square, and how
// far its neglect puts a point.
class ScreenedEffect : public ::testing::TestWithParam<std::string> {};

TEST_P(ScreenedEffect, IsAsTheJointFitHasIt) {
  const Measured measured = Measure({GetParam()}, 3);
  const Eigen::Vector3d p = measured.scene.p_in_tool;
  const Screening screening = Screen(measured.dataset, Quick(), {p, {0, 0, 0}});
  ASSERT_THAT(screening.named, SizeIs(1));
  const Hypothesis& found = screening.tested.front();
  EXPECT_EQ(found.name, GetParam());
  EXPECT_TRUE(found.is_named);
  EXPECT_LT(found.p_value, 1e-6);
  EXPECT_LE(found.own_p_value, found.p_value);
  EXPECT_LT(found.aic_change, 0.0);
  EXPECT_NEAR(found.aic_change, 2.0 * found.parameters - found.gain, 1e-9);

  const Estimate alone = Calibrate(MakeObservations(measured.dataset), {}, {});
  const GrownCalibration joint = CalibrateGrown(measured.dataset, measured.scene.model, {});
  double squares = 0.0;
  const std::vector<Pose3d> predicted = Predict(joint.machine, measured.dataset);
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const Pose3d& reported = measured.dataset.robot_poses.rows[i].base_from_platform;
    Pose3d tool = predicted[i];
    squares +=
        (alone.mounts.world_from_base * reported * alone.mounts.platform_from_tool * p - tool * p)
            .squaredNorm();
  }
  ASSERT_THAT(found.at_points, SizeIs(2));
  EXPECT_NEAR(found.at_points[0] / std::sqrt(squares / 60.0), 1.0, 0.05);
  const Effect& effect = joint.machine.effects[0];
  Eigen::Index at = 0;
  (effect.parameters.array() - found.size).abs().minCoeff(&at);
  EXPECT_NEAR(found.size, effect.parameters[at], 2.0 * effect.standard_deviation[at]);
  EXPECT_EQ(found.unit, FindEffectKind(GetParam())->UnitOf(static_cast<int>(at)));
  EXPECT_NEAR(found.standard_uncertainty / effect.standard_deviation[at], 1.0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Effects,
                         ScreenedEffect,
                         ::testing::Values("tracker_scale", "tool_thermal", "leg_gain"),
                         [](const auto& tested) { return tested.param; });

// The steps of BIC and AIC are apart by the logarithm of the number of rows.
TEST(Screening, OfDataThatLackNothingNamesNothing) {
  const Measured measured = Measure({}, 5);
  const Screening screening = Screen(measured.dataset, Quick(), {{0, 0, 0.1}});
  EXPECT_THAT(screening.named, IsEmpty());
  EXPECT_GT(screening.tested.size(), 20u);
  EXPECT_GT(screening.hypotheses, static_cast<int>(screening.tested.size()));
  for (const Hypothesis& one : screening.tested) {
    EXPECT_FALSE(one.is_named) << one.name;
    EXPECT_GT(one.p_value, 0.01) << one.name;
    EXPECT_LE(one.own_p_value, one.p_value) << one.name;
    EXPECT_GT(one.bic_change, one.aic_change) << one.name;
    EXPECT_GE(one.gain, 0.0) << one.name;
    EXPECT_GT(one.standard_uncertainty, 0.0) << one.name;
    EXPECT_GT(one.at_points.at(0), 0.0) << one.name;
  }
}

// What rounding leaves is no noise that an effect could stand out of: markers under each other's
// names, units and offsets were found in it.
TEST(Screening, OfExactDataNamesNothing) {
  for (const bool noise_is_stated : {true, false}) {
    Measured measured = Measure({}, 5, 0.0);
    if (!noise_is_stated) measured.dataset.measurement->marker_sigma.reset();
    const Screening screening = Screen(measured.dataset, Quick(), {{0, 0, 0.1}});
    EXPECT_THAT(screening.named, IsEmpty());
    EXPECT_GT(screening.tested.size(), 20u);
  }
}

// However small it is, what is not rounding has a name.
TEST(Screening, OfExactDataNamesWhatIsHidden) {
  const Measured measured = Measure({"tool_thermal"}, 3, 0.0);
  const Screening screening = Screen(measured.dataset, Quick(), {});
  ASSERT_THAT(screening.named, SizeIs(1));
  EXPECT_EQ(screening.tested.front().name, "tool_thermal");
}

// What is in the model already is no longer missing.
TEST(Screening, StartsFromAModel) {
  const Measured measured = Measure({"tool_thermal"}, 3);
  DiscoverOptions options = Quick();
  options.model = measured.scene.model;
  EXPECT_THAT(Screen(measured.dataset, options, {}).named, IsEmpty());
}

// Of many poses some are enough; what is hidden in all of them shows in every third.
TEST(Screening, TakesSomeOfManyPoses) {
  const Measured measured = Measure({"tool_thermal"}, 3);
  const Screening screening = Screen(measured.dataset, Quick(), {}, 29);
  EXPECT_EQ(screening.of, 60);
  EXPECT_EQ(screening.poses, 20);
  ASSERT_THAT(screening.named, SizeIs(1));
  EXPECT_EQ(screening.tested.front().name, "tool_thermal");
  EXPECT_EQ(Screen(measured.dataset, Quick(), {}, 60).poses, 60);
}

TEST(Screening, SaysWhatTheDataCannotTell) {
  Measured measured = Measure({}, 5);
  auto& columns = measured.dataset.robot_poses.covariates;
  columns.erase(columns.begin());  // the temperature
  const Screening screening = Screen(measured.dataset, Quick(), {});
  bool is_said = false;
  for (const NotTestable& one : screening.not_testable) is_said |= one.name == "leg_thermal";
  EXPECT_TRUE(is_said);
  for (const Hypothesis& one : screening.tested) EXPECT_NE(one.name, "leg_thermal");
}

}  // namespace
}  // namespace hexcal
