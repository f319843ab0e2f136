// SPDX-License-Identifier: BSD-3-Clause
// A hexapod of which nobody published the legs, moved by kinematics of their own (hidden/legs.h).
#include "discovery/unknown_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <set>
#include <string>

#include "discovery/discover.h"
#include "hidden/as_dataset.h"
#include "hidden/legs.h"
#include "model/nominal_hexapod.h"
#include "model/predict.h"
#include "testing/random.h"

namespace hexcal {
namespace {

constexpr int kMeasured = 60, kRows = 100;
constexpr double kPosition = 2e-5, kOrientation = 6e-5;  // noise, m and rad

struct Hidden {
  Dataset dataset;
  std::vector<Pose3d> truth;  // world_from_tool of every row, without noise
  NominalHexapod nominal;
};

// error: 1-sigma of the places of joints and of the legs' zeros, m.
Hidden MakeHidden(double error, int seed) {
  std::mt19937_64 rng(seed);
  Hidden hidden;
  NominalHexapod& nominal = hidden.nominal;
  nominal.base_radius = 0.45, nominal.platform_radius = 0.33;
  nominal.base_half_angle = 0.15, nominal.platform_half_angle = 0.2;
  nominal.base_height = -0.55, nominal.platform_height = -0.03;
  nominal.yaw = M_PI / 6.0;
  const HexapodGeometry drawn = MakeHexapod(nominal);
  const auto off = [&] {
    const Eigen::VectorXd draw = error * testing::Normal(rng, 18);
    return Matrix36d(Eigen::Map<const Matrix36d>(draw.data()));
  };
  const Matrix36d base = drawn.base_joints_in_base + off(),
                  platform = drawn.platform_joints_in_platform + off();
  const hidden::Six zeros = error * testing::Normal(rng, 6);
  const Pose3d world_from_base = testing::RandomPose(rng, 1.0);
  const Pose3d platform_from_tool = testing::SmallPose(rng, 0.1, 0.5);

  Dataset& dataset = hidden.dataset;
  dataset.path = "dataset.yaml", dataset.name = "unpublished";
  dataset.robot_poses.where = FileLocation("poses.csv");
  Measurement measurement;
  measurement.kind = Measurement::Kind::kPoses;
  measurement.pose_noise.emplace();
  measurement.pose_noise->position.setConstant(kPosition);
  measurement.pose_noise->orientation.setConstant(kOrientation);
  for (int row = 0; row < kRows; ++row) {
    const Pose3d reported = testing::SmallPose(rng, 0.08, 0.2);
    hidden::Motion moved = hidden::AsMotion(reported);
    const hidden::Six lengths =
        hidden::LegLengths(drawn.base_joints_in_base, drawn.platform_joints_in_platform, moved) +
        zeros;
    EXPECT_TRUE(hidden::CloseLoop(base, platform, lengths, &moved));
    hidden.truth.push_back(world_from_base * hidden::AsPose(moved) * platform_from_tool);
    dataset.robot_poses.rows.push_back({std::to_string(row), reported, {}, row + 2});
    if (row >= kMeasured) continue;
    Vector6d noise = testing::Normal(rng, 6);
    noise.head<3>() *= kPosition, noise.tail<3>() *= kOrientation;
    measurement.poses.push_back({row, Plus(hidden.truth.back(), noise)});
  }
  dataset.measurement = measurement;
  return hidden;
}

DiscoverOptions Quick() {
  DiscoverOptions options;
  options.bootstraps = 99;
  options.folds = 3;
  return options;
}

double PositionRms(const std::vector<Pose3d>& a, const std::vector<Pose3d>& b, int first) {
  double sum = 0.0;
  for (std::size_t i = first; i < a.size(); ++i)
    sum += (a[i].translation - b[i].translation).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size() - first));
}

struct Pair {
  Hidden hidden;
  Discovery discovery;
};
const Pair& Found() {
  static const Pair pair = [] {
    Pair made{MakeHidden(3e-4, 1), {}};
    made.discovery = Discover(made.hidden.dataset, Quick());
    return made;
  }();
  return pair;
}

TEST(UnknownGeometry, WinsAgainstTheMapWhereItIsTheCause) {
  const Discovery& discovery = Found().discovery;
  ASSERT_TRUE(discovery.leg_geometry.has_value());
  const GeometryClass& geometry = *discovery.leg_geometry;
  EXPECT_TRUE(geometry.is_in_model);
  EXPECT_TRUE(geometry.is_complete);
  EXPECT_LT(geometry.heldout.chi_square, geometry.heldout_map.chi_square);
  EXPECT_EQ(discovery.verdict, Verdict::kExplained);
  ASSERT_EQ(discovery.effects.size(), 1u);
  // One class, under its most probable member.
  std::set<std::string> members = {discovery.effects[0].effect.name};
  for (const Rival& rival : discovery.effects[0].could_also_be) members.insert(rival.name);
  for (const char* name : {"base_joint_offset", "platform_joint_offset", "leg_offset", "unknown"})
    EXPECT_EQ(members.count(name), 1u) << name;
  EXPECT_NE(discovery.effects[0].description.find("base radius"), std::string::npos);
  for (const NotTestable& effect : discovery.not_testable)
    EXPECT_NE(effect.name, "base_joint_offset");
  // The step to it is the last, and ends where the gap does.
  EXPECT_EQ(discovery.steps.back().added, "base_joint_offset");
  EXPECT_EQ(discovery.steps.back().after.chi_square, discovery.gap.after.chi_square);
  // The noise of a pose that is held out, and what the parameters add.
  EXPECT_LT(geometry.heldout.rms_position, 1.5 * kPosition * std::sqrt(3.0));
  EXPECT_NEAR(discovery.gap.after.chi_square / discovery.gap.after.degrees_of_freedom, 1.0, 0.25);
}

TEST(UnknownGeometry, TheMachineForetellsPosesThatWereNeverMeasured) {
  const Hidden& hidden = Found().hidden;
  const Discovery& discovery = Found().discovery;
  Machine alone;
  alone.world_from_base = discovery.base_and_tool.mounts.world_from_base;
  alone.platform_from_tool = discovery.base_and_tool.mounts.platform_from_tool;
  const double before = PositionRms(Predict(alone, hidden.dataset), hidden.truth, kMeasured);
  const double after =
      PositionRms(Predict(discovery.machine, hidden.dataset), hidden.truth, kMeasured);
  EXPECT_LT(after, kPosition * std::sqrt(3.0));
  EXPECT_GT(before, 5.0 * after);
  EXPECT_FALSE(discovery.machine.pose_map.has_value());
  // As it is written and read again.
  const std::string path = ::testing::TempDir() + "/unknown_geometry_test_model.yaml";
  std::ofstream(path) << WriteMachine(discovery.machine);
  EXPECT_EQ(PositionRms(Predict(ReadMachine(path), hidden.dataset),
                        Predict(discovery.machine, hidden.dataset),
                        0),
            0.0);
}

// 18 bounds of 95 % that are not independent: 14 at least.
TEST(UnknownGeometry, ItsBoundsHoldTheDrawing) {
  DiscoverOptions options = Quick();
  options.folds = 0, options.most_effects = 1;
  int inside = 0;
  for (const int seed : {1, 2, 3}) {
    const Hidden hidden = MakeHidden(5e-4, seed);
    const Discovery discovery = Discover(hidden.dataset, options);
    ASSERT_TRUE(discovery.leg_geometry.has_value());
    // Nothing was held out, so nothing was decided.
    EXPECT_FALSE(discovery.leg_geometry->is_in_model);
    EXPECT_TRUE(discovery.machine.pose_map.has_value());
    const NominalHexapod& nominal = hidden.nominal;
    const std::vector<double> truth = {nominal.base_radius,
                                       nominal.platform_radius,
                                       nominal.base_half_angle,
                                       nominal.platform_half_angle,
                                       nominal.base_height,
                                       nominal.platform_height};
    const std::vector<Bound>& bounds = discovery.leg_geometry->bounds;
    ASSERT_EQ(bounds.size(), truth.size());
    for (std::size_t k = 0; k < truth.size(); ++k)
      inside += bounds[k].lower <= truth[k] && truth[k] <= bounds[k].upper;
    // They say something: within a factor of two.
    EXPECT_LT(bounds[0].upper, 2.0 * bounds[0].lower);
    EXPECT_NEAR(discovery.leg_geometry->yaw, nominal.yaw, 1e-12);
  }
  EXPECT_GE(inside, 14);
}

// Another effect, which does not follow the pose, stays beside it.
TEST(UnknownGeometry, LeavesADriftInTheModel) {
  Hidden hidden = MakeHidden(3e-4, 4);
  for (MeasuredPose& pose : hidden.dataset.measurement->poses) {
    Vector6d drift = Vector6d::Zero();
    drift[1] = 3e-4 * pose.pose / kMeasured;
    pose.world_from_tool = Plus(Pose3d(), drift) * pose.world_from_tool;
  }
  DiscoverOptions options = Quick();
  options.folds = 2;
  const Discovery discovery = Discover(hidden.dataset, options);
  ASSERT_TRUE(discovery.leg_geometry && discovery.leg_geometry->is_in_model);
  std::set<std::string> names;
  for (const DiscoveredEffect& found : discovery.effects) names.insert(found.effect.name);
  EXPECT_EQ(names, (std::set<std::string>{"base_drift", "base_joint_offset"}));
  EXPECT_NEAR(discovery.gap.after.chi_square / discovery.gap.after.degrees_of_freedom, 1.0, 0.25);
}

// What no hexapod does: a twist of the tool that is linear in the pose, at random.
TEST(UnknownGeometry, LosesAgainstTheMapWhereItIsNotTheCause) {
  Hidden hidden = MakeHidden(0.0, 3);
  std::mt19937_64 rng(3);
  Matrix6d slopes;
  for (int k = 0; k < 6; ++k) slopes.col(k) = testing::Normal(rng, 6);
  slopes.topRows<3>() *= 2e-4, slopes.bottomRows<3>() *= 6e-4;
  for (MeasuredPose& pose : hidden.dataset.measurement->poses) {
    const Pose3d& reported = hidden.dataset.robot_poses.rows[pose.pose].base_from_platform;
    Vector6d coordinates;
    coordinates << reported.translation / 0.08, Log(reported.rotation) / 0.2;
    pose.world_from_tool = Plus(pose.world_from_tool, Vector6d(slopes * coordinates));
  }
  const Discovery discovery = Discover(hidden.dataset, Quick());
  ASSERT_TRUE(discovery.leg_geometry.has_value());
  EXPECT_FALSE(discovery.leg_geometry->is_in_model);
  EXPECT_FALSE(discovery.leg_geometry->is_complete);
  EXPECT_FALSE(discovery.machine.hexapod.has_value());
  EXPECT_TRUE(discovery.machine.pose_map.has_value());
  EXPECT_EQ(discovery.verdict, Verdict::kPartlyExplained);
}

TEST(UnknownGeometry, IsNotAskedForWhereNothingIsLeft) {
  const Discovery discovery = Discover(MakeHidden(0.0, 1).dataset, Quick());
  EXPECT_EQ(discovery.verdict, Verdict::kAgrees);
  EXPECT_FALSE(discovery.leg_geometry.has_value());
  EXPECT_FALSE(discovery.machine.hexapod.has_value());
}

}  // namespace
}  // namespace hexcal
