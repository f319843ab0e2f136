// SPDX-License-Identifier: BSD-3-Clause
// The effects one by one against worked values; effect_table_test has the laws that all obey.
#include <cmath>

#include "model/effect.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::SeededByTest;

using Row6 = Eigen::Matrix<double, 1, 6>;

Vector6d Six(double a, double b, double c, double d, double e, double f) {
  Vector6d v;
  v << a, b, c, d, e, f;
  return v;
}

// One effect, its parameters given, in one visit.
Corrections<double> Apply(const std::string& name,
                          const std::vector<double>& parameters,
                          const Visit& visit,
                          const EffectReference& reference = {},
                          const std::vector<int>& index = {}) {
  Effect effect;
  effect.name = name;
  effect.index = index;
  effect.parameters = Eigen::Map<const Eigen::VectorXd>(parameters.data(), parameters.size());
  effect.reference = reference;
  return CorrectionsOf({effect}, visit);
}

std::vector<double> Zeros(int n) { return std::vector<double>(n, 0.0); }

// Legs of 0.2 m and more at home 0.2 m.
Visit LegsOf(const LegLengths& lengths) {
  Visit visit;
  visit.lengths = lengths;
  visit.home_lengths.setConstant(0.2);
  return visit;
}

// Level, payload of 2 kg at the origin of A, gravity straight down; vertical legs on a circle.
Visit LoadedVisit() {
  HexapodGeometry hexapod;
  for (int i = 0; i < kNumLegs; ++i) {
    const double angle = i * M_PI / 3.0;
    hexapod.base_joints_in_base.col(i) << 0.1 * std::cos(angle), 0.1 * std::sin(angle), 0.0;
    // Turned a little, or vertical legs would not hold the platform.
    const double turned = angle + (i % 2 == 0 ? 0.5 : -0.5);
    hexapod.platform_joints_in_platform.col(i) << 0.1 * std::cos(turned), 0.1 * std::sin(turned),
        0.0;
  }
  const std::vector<Pose3d> poses = {{Eigen::Vector3d(0, 0, 0.3), Eigen::Quaterniond::Identity()}};
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.gravity_in_base = -Eigen::Vector3d::UnitZ();
  dataset.robot_poses.covariates.push_back({"payload", Unit(), {2.0}});
  return MakeVisits(dataset, &hexapod, poses)[0];
}

TEST(LegOffset, AddsToTheLeg) {
  const Corrections<double> c = Apply("leg_offset", {1, 2, 3, 4, 5, 6}, Visit());
  EXPECT_EQ(c.leg, Six(1, 2, 3, 4, 5, 6));
}

TEST(LegGain, CountsFromHome) {
  const Visit visit = LegsOf(Six(0.2, 0.21, 0.22, 0.19, 0.18, 0.3));
  const Corrections<double> c = Apply("leg_gain", {1e-3, 1e-3, 2e-3, 1e-3, 1e-3, 0}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, Six(0, 1e-5, 4e-5, -1e-5, -2e-5, 0), 1e-18));
}

TEST(LegGain, TakesHomeOfTheReferenceWhereItHasOne) {
  const EffectReference reference = {{"home_lengths", std::vector<double>(6, 0.1)}};
  const Visit visit = LegsOf(LegLengths::Constant(0.25));
  const Corrections<double> c = Apply("leg_gain", {1, 0, 0, 0, 0, 0}, visit, reference);
  EXPECT_TRUE(MatrixNear(c.leg, Six(0.15, 0, 0, 0, 0, 0), 1e-16));
}

TEST(LegNonlinearity, IsAParabolaAboutHome) {
  const Visit visit = LegsOf(Six(0.2, 0.21, 0.22, 0.19, 0.18, 0.3));
  const Corrections<double> c = Apply("leg_nonlinearity", {1, 1, 0.5, 1, 1, 0}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, Six(0, 1e-4, 2e-4, 1e-4, 4e-4, 0), 1e-17));
}

TEST(LegPeriodic, IsASineOfTheLengthItself) {
  const double period = 0.004;
  const Visit visit =
      LegsOf(Six(0.2, 0.201, 0.2, 0.2 + period / 12, 0.2 + period / 8, 0.2 + period / 8));
  std::vector<double> parameters = Zeros(25);
  const double amplitude[] = {1, 2, 3, 4, 0, 1};
  std::copy(amplitude, amplitude + 6, parameters.begin());
  parameters[8] = M_PI / 2;  // phase of leg 3
  parameters[12] = period;
  const double second[] = {0, 0, 0, 0, 5, 7};
  std::copy(second, second + 6, parameters.begin() + 13);
  parameters[24] = -M_PI / 2;  // second phase of leg 6
  const Corrections<double> c = Apply("leg_periodic", parameters, visit);
  EXPECT_TRUE(MatrixNear(c.leg, Six(0, 2, 3, 2, 5, std::sqrt(0.5)), 1e-12));
}

TEST(LegScrewRotation, IsTheLeadTimesTheRoll) {
  Visit visit;
  visit.roll = Six(0.1, 0.2, 0, 0, -0.1, 0.3);
  const Corrections<double> c = Apply("leg_screw_rotation", {2e-3}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, 2e-3 * visit.roll, 1e-18));
}

TEST(LegScrewRotation, CountsFromTheReferencesHome) {
  Visit visit;
  visit.roll.setConstant(0.1);
  visit.home_roll.setConstant(3.1);  // so the legs stand at 3.2, which is -3.0832
  const EffectReference reference = {{"home_roll", std::vector<double>(6, -3.1)}};
  const Corrections<double> c = Apply("leg_screw_rotation", {1}, visit, reference);
  EXPECT_TRUE(MatrixNear(c.leg, Vector6d::Constant(6.3 - 2 * M_PI), 1e-14));
}

TEST(LegBacklash, IsHalfTheGapEitherWay) {
  Visit visit;
  visit.direction = Six(1, -1, 0, 1, -1, 1);
  const Corrections<double> c = Apply("leg_backlash", {2, 2, 2, 4, 6, 0}, visit);
  EXPECT_EQ(c.leg, Six(1, -1, 0, 2, -3, 0));
}

TEST(LegThermal, GrowsInProportionToTheLength) {
  Visit visit = LegsOf(Six(0.2, 0.3, 0.2, 0.2, 0.2, 0.2));
  visit.temperature = 25.0;
  const EffectReference reference = {{"reference_temperature", {20.0}}};
  const Corrections<double> c = Apply("leg_thermal", {1e-5}, visit, reference);
  EXPECT_TRUE(MatrixNear(c.leg, Six(1e-5, 1.5e-5, 1e-5, 1e-5, 1e-5, 1e-5), 1e-18));
}

TEST(LegThermal, OfTheLegsInTheIndexOnly) {
  Visit visit = LegsOf(LegLengths::Constant(0.2));
  visit.temperature = 19.0;
  const EffectReference reference = {{"reference_temperature", {20.0}}};
  const Corrections<double> c = Apply("leg_thermal", {1e-5}, visit, reference, {2, 6});
  EXPECT_TRUE(MatrixNear(c.leg, Six(0, -2e-6, 0, 0, 0, -2e-6), 1e-19));
}

TEST(Settling, LeavesAFractionOfTheLastMove) {
  Visit visit;
  visit.last_move = Six(0.01, -0.02, 0, 0.03, 0, 0);
  const Corrections<double> c = Apply("settling", {0.1}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, Six(-0.001, 0.002, 0, -0.003, 0, 0), 1e-18));
}

// Six legs, each inclined alike, share the weight alike: the part of each push along z is a sixth.
TEST(LegCompliance, ShortensPushedLegsByTheirShareOfTheWeight) {
  const Visit visit = LoadedVisit();
  const double climb = visit.legs_in_base(2, 0);
  const double force = 2.0 * 9.80665 / (6 * climb);
  const Corrections<double> c = Apply("leg_compliance", {1e-6, 0, 0}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, Vector6d::Constant(-1e-6 * force), 1e-18));
  // The platform's own mass weighs where there is no payload, too.
  Visit empty = visit;
  empty.payload = 0.0;
  const Corrections<double> own = Apply("leg_compliance", {1e-6, 2, 0.1}, empty);
  EXPECT_TRUE(MatrixNear(own.leg, c.leg, 1e-18));
}

// Seen from the base, not from the platform, and force by force: what the legs push and gravity
// pulls is in balance, about any point.
TEST(LegCompliance, HasForcesInBalanceWithGravity) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  for (int n = 0; n < 20; ++n) {
    const Pose3d pose = testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.4);
    Dataset dataset = testing::DatasetOfPoses({pose});
    dataset.gravity_in_base = testing::Normal(rng, 3).normalized();
    const Eigen::Vector3d centre = testing::UniformVector(rng, 0.1);
    const double payload = 7.0, mass = 3.0, height = 0.2;
    auto& covariates = dataset.robot_poses.covariates;
    covariates.push_back({"payload", Unit(), {payload}});
    covariates.push_back({"payload_x", Unit(), {centre.x()}});
    covariates.push_back({"payload_y", Unit(), {centre.y()}});
    covariates.push_back({"payload_z", Unit(), {centre.z()}});
    const Visit visit = MakeVisits(dataset, &hexapod, {pose})[0];
    const Vector6d force = -Apply("leg_compliance", {1, mass, height}, visit).leg;
    const Eigen::Vector3d g = 9.80665 * *dataset.gravity_in_base;
    const Eigen::Vector3d raised = centre + Eigen::Vector3d(0, 0, height);
    Eigen::Vector3d sum = (payload + mass) * g;
    Eigen::Vector3d moment = (pose * raised).cross(payload * g) + pose.translation.cross(mass * g);
    for (int i = 0; i < kNumLegs; ++i) {
      const Eigen::Vector3d lower = hexapod.base_joints_in_base.col(i);
      const Eigen::Vector3d joint = hexapod.platform_joints_in_platform.col(i);
      const Eigen::Vector3d push = force[i] * (pose * joint - lower).normalized();
      sum += push;
      moment += (pose * joint).cross(push);
    }
    EXPECT_TRUE(MatrixNear(sum, Eigen::Vector3d::Zero(), 1e-9));
    EXPECT_TRUE(MatrixNear(moment, Eigen::Vector3d::Zero(), 1e-9));
  }
}

TEST(LegClearance, IsHalfTheGapOnTheSideOfTheLoad) {
  Visit visit = LoadedVisit();
  EXPECT_TRUE(
      MatrixNear(Apply("leg_clearance", {2e-5}, visit).leg, Vector6d::Constant(-1e-5), 0.0));
  visit.gravity_in_base *= -1.0;
  EXPECT_TRUE(MatrixNear(Apply("leg_clearance", {2e-5}, visit).leg, Vector6d::Constant(1e-5), 0.0));
  visit.payload = 0.0;
  EXPECT_TRUE(MatrixNear(Apply("leg_clearance", {2e-5}, visit).leg, Vector6d::Zero(), 0.0));
}

TEST(JointOffset, MovesOneJointOfOnePlate) {
  std::vector<double> offset = Zeros(18);
  offset[3 * 2 + 0] = 1, offset[3 * 2 + 1] = 2, offset[3 * 2 + 2] = 3;
  Matrix36d expected = Matrix36d::Zero();
  expected.col(2) << 1, 2, 3;
  const Corrections<double> base = Apply("base_joint_offset", offset, Visit());
  EXPECT_EQ(base.base_joints, expected);
  EXPECT_EQ(base.platform_joints, Matrix36d::Zero());
  const Corrections<double> platform = Apply("platform_joint_offset", offset, Visit());
  EXPECT_EQ(platform.platform_joints, expected);
  EXPECT_EQ(platform.base_joints, Matrix36d::Zero());
}

TEST(Radius, GrowsEachJointAwayFromTheCentre) {
  const Visit visit = LoadedVisit();
  Matrix36d base, platform;
  for (int i = 0; i < kNumLegs; ++i) {
    const double angle = i * M_PI / 3.0, turned = angle + (i % 2 == 0 ? 0.5 : -0.5);
    base.col(i) << std::cos(angle), std::sin(angle), 0.0;
    platform.col(i) << std::cos(turned), std::sin(turned), 0.0;
  }
  EXPECT_TRUE(MatrixNear(Apply("base_radius", {2}, visit).base_joints, 2 * base, 1e-14));
  EXPECT_EQ(Apply("base_radius", {2}, visit).platform_joints, Matrix36d::Zero());
  EXPECT_TRUE(
      MatrixNear(Apply("platform_radius", {2}, visit).platform_joints, 2 * platform, 1e-14));
}

TEST(JointAxisOffset, IsTheSineOfTheAngleToTheAxis) {
  Visit visit;
  visit.base_axis_cosine = Six(0, 1, 0.6, -0.6, 0, 0);
  visit.platform_axis_cosine = Six(1, 0.8, 0.8, 0.8, -0.8, 1);
  const Corrections<double> c = Apply("joint_axis_offset", {1, 10}, visit);
  EXPECT_TRUE(MatrixNear(c.leg, -Six(1, 6, 6.8, 6.8, 7, 1), 1e-14));
}

TEST(PlateThermal, GrowsBothPlates) {
  Visit visit = LoadedVisit();
  visit.temperature = 23.0;
  const EffectReference reference = {{"reference_temperature", {20.0}}};
  const Corrections<double> c = Apply("plate_thermal", {1e-5}, visit, reference);
  EXPECT_TRUE(MatrixNear(c.base_joints, 3e-5 * visit.plates->base_joints, 1e-20));
  EXPECT_TRUE(MatrixNear(c.platform_joints, 3e-5 * visit.plates->platform_joints, 1e-20));
  EXPECT_EQ(c.leg, Vector6d::Zero());
}

const EffectReference kSeconds = {
    {"time_origin", {100.0}}, {"time_span", {50.0}}, {"time_is_row", {0.0}}};
const EffectReference kRows = {
    {"time_origin", {0.0}}, {"time_span", {10.0}}, {"time_is_row", {1.0}}};

TEST(Drift, IsTheWholeTwistAtTheEnd) {
  Visit visit;
  visit.time = 150.0;
  const Vector6d twist = Six(1, 2, 3, 4, 5, 6);
  EXPECT_EQ(Apply("base_drift", {1, 2, 3, 4, 5, 6, 0}, visit, kSeconds).base_twist, twist);
  EXPECT_TRUE(MatrixNear(
      Apply("base_drift", {1, 2, 3, 4, 5, 6, 7}, visit, kSeconds).base_twist, twist, 1e-15));
  EXPECT_EQ(Apply("tool_drift", {1, 2, 3, 4, 5, 6, 0}, visit, kSeconds).tool_twist, twist);
  EXPECT_EQ(Apply("tool_drift", {1, 2, 3, 4, 5, 6, 0}, visit, kSeconds).base_twist,
            Vector6d::Zero());
  visit.time = 100.0;
  EXPECT_EQ(Apply("base_drift", {1, 2, 3, 4, 5, 6, 0}, visit, kSeconds).base_twist,
            Vector6d::Zero());
}

TEST(Drift, GoesStraightOrWithATimeConstant) {
  Visit visit;
  visit.time = 110.0;
  const Vector6d twist = Six(1, 2, 3, 4, 5, 6);
  EXPECT_TRUE(MatrixNear(
      Apply("base_drift", {1, 2, 3, 4, 5, 6, 0}, visit, kSeconds).base_twist, 0.2 * twist, 1e-15));
  const double share = (1 - std::exp(-1.0)) / (1 - std::exp(-5.0));
  EXPECT_TRUE(MatrixNear(Apply("base_drift", {1, 2, 3, 4, 5, 6, 10}, visit, kSeconds).base_twist,
                         share * twist,
                         1e-14));
  // A time constant of ages is straight.
  EXPECT_TRUE(MatrixNear(
      Apply("base_drift", {1, 2, 3, 4, 5, 6, 1e7}, visit, kSeconds).base_twist, 0.2 * twist, 1e-5));
}

TEST(Drift, CountsRowsWithoutTime) {
  Visit visit;
  visit.row = 3;
  visit.time = std::nan("");
  const Corrections<double> c = Apply("tool_drift", {1, 0, 0, 0, 0, 0, 0}, visit, kRows);
  EXPECT_NEAR(c.tool_twist[0], 0.3, 1e-15);
}

TEST(Step, ComesAtItsTime) {
  Visit visit;
  const std::vector<double> parameters = {1, 2, 3, 4, 5, 6, 120};
  for (const double time : {119.9, 120.0, 121.0}) {
    visit.time = time;
    const Vector6d expected = time < 120.0 ? Vector6d::Zero() : Six(1, 2, 3, 4, 5, 6);
    EXPECT_EQ(Apply("base_step", parameters, visit, kSeconds).base_twist, expected);
    EXPECT_EQ(Apply("tool_step", parameters, visit, kSeconds).tool_twist, expected);
    EXPECT_EQ(Apply("tool_step", parameters, visit, kSeconds).base_twist, Vector6d::Zero());
  }
  visit.row = 5;
  EXPECT_EQ(Apply("base_step", {1, 0, 0, 0, 0, 0, 5}, visit, kRows).base_twist[0], 1.0);
  EXPECT_EQ(Apply("base_step", {1, 0, 0, 0, 0, 0, 5.5}, visit, kRows).base_twist[0], 0.0);
}

// 2 kg, 0.1 m out along x, pull that side down: right-handed about +y.
TEST(BaseFlexure, TurnsTheBaseAboutTheMomentOfTheLoad) {
  Visit visit;
  visit.payload = 2.0;
  visit.gravity_in_base = -Eigen::Vector3d::UnitZ();
  visit.base_from_platform.translation << 0.1, 0, 0.3;
  const Corrections<double> c = Apply("base_flexure", {1e-5}, visit);
  EXPECT_TRUE(MatrixNear(c.base_twist, Six(0, 0, 0, 0, 1e-5 * 0.1 * 2 * 9.80665, 0), 1e-20));
}

// Platform rolled by 90 degrees about x: down is -z in the base, so -y in the platform.
TEST(ToolSag, FollowsGravityInThePlatform) {
  Visit visit;
  visit.gravity_in_base = -Eigen::Vector3d::UnitZ();
  visit.base_from_platform.rotation = Exp(Eigen::Vector3d(M_PI / 2, 0, 0));
  const Corrections<double> c = Apply("tool_sag", {1e-4, 1e-3}, visit);
  // z cross -y is +x.
  EXPECT_TRUE(MatrixNear(c.tool_twist, Six(0, -1e-4, 0, 1e-3, 0, 0), 1e-18));
  visit.base_from_platform.rotation.setIdentity();
  const Corrections<double> level = Apply("tool_sag", {1e-4, 1e-3}, visit);
  EXPECT_TRUE(MatrixNear(level.tool_twist, Six(0, 0, -1e-4, 0, 0, 0), 1e-18));
}

TEST(ToolThermal, FollowsTheTemperature) {
  Visit visit;
  visit.temperature = 18.0;
  const EffectReference reference = {{"reference_temperature", {20.0}}};
  const Corrections<double> c = Apply("tool_thermal", {1, 2, 3, 4, 5, 6}, visit, reference);
  EXPECT_EQ(c.tool_twist, Six(-2, -4, -6, -8, -10, -12));
}

TEST(Latency, MovesThePlatformOn) {
  Visit visit;
  visit.velocity = Six(1, 2, 3, 4, 5, 6);
  const Corrections<double> c = Apply("latency", {0.5}, visit);
  EXPECT_EQ(c.platform_twist, Six(0.5, 1, 1.5, 2, 2.5, 3));
}

TEST(TrackerEffects, SetTheTrackersNumbers) {
  EXPECT_EQ(Apply("tracker_scale", {2}, Visit()).tracker_scale, 2.0);
  EXPECT_EQ(Apply("tracker_depth_scale", {2}, Visit()).tracker_depth_scale, 2.0);
  EXPECT_EQ(Apply("tracker_distortion", {2}, Visit()).tracker_distortion, 2.0);
  EXPECT_EQ(Apply("tracker_distortion", {2}, Visit()).tracker_scale, 0.0);
}

TEST(TrackerWarmup, FadesFromTheFirstReading) {
  Visit visit;
  visit.time = 100.0;
  const std::vector<double> parameters = {1, 2, 3, 4, 5, 6, 7, 20};
  const Corrections<double> cold = Apply("tracker_warmup", parameters, visit, kSeconds);
  EXPECT_EQ(cold.tracker_twist, Six(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(cold.tracker_scale, 7.0);
  visit.time = 140.0;
  const Corrections<double> warm = Apply("tracker_warmup", parameters, visit, kSeconds);
  EXPECT_TRUE(MatrixNear(warm.tracker_twist, std::exp(-2.0) * cold.tracker_twist, 1e-15));
  EXPECT_NEAR(warm.tracker_scale, 7.0 * std::exp(-2.0), 1e-15);
}

TEST(MarkerOffset, MovesTheMarkersInTheIndexBaseFirst) {
  const EffectReference reference = {{"markers", {4.0, 3.0}}};
  const Corrections<double> c =
      Apply("marker_offset", {1, 2, 3, 4, 5, 6}, Visit(), reference, {2, 5});
  Eigen::Matrix3Xd base = Eigen::Matrix3Xd::Zero(3, 4), tool = Eigen::Matrix3Xd::Zero(3, 3);
  base.col(1) << 1, 2, 3;
  tool.col(0) << 4, 5, 6;
  EXPECT_TRUE(MatrixNear(c.markers[0], base, 0.0));
  EXPECT_TRUE(MatrixNear(c.markers[1], tool, 0.0));
}

TEST(MarkerShift, ComesAtItsTime) {
  EffectReference reference = kSeconds;
  reference["markers"] = {3.0, 3.0};
  Visit visit;
  visit.time = 119.0;
  const std::vector<double> parameters = {120, 1, 2, 3};
  EXPECT_EQ(Apply("marker_shift", parameters, visit, reference, {6}).markers[1].size(), 0);
  visit.time = 120.0;
  const Corrections<double> c = Apply("marker_shift", parameters, visit, reference, {6});
  EXPECT_EQ(Eigen::Vector3d(c.markers[1].col(2)), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(c.markers[0].isZero(0.0) && c.markers[1].leftCols(2).isZero(0.0));
}

TEST(CorrectionsOf, AddUpOverEffects) {
  Visit visit;
  visit.direction = Vector6d::Ones();
  Effect offset, backlash, unknown, fault;
  offset.name = "leg_offset";
  offset.parameters = Six(1, 2, 3, 4, 5, 6);
  backlash.name = "leg_backlash";
  backlash.parameters = Vector6d::Constant(2);
  unknown.name = "unknown";
  unknown.parameters = Eigen::VectorXd::Ones(3);
  fault.name = "swapped_legs";
  const Corrections<double> c = CorrectionsOf({offset, backlash, unknown, fault}, visit);
  EXPECT_EQ(c.leg, Six(2, 3, 4, 5, 6, 7));
}

TEST(CorrectionsOf, RefusesWhatIsNoEffect) {
  EXPECT_DEATH(Apply("leg_ofset", {1, 2, 3, 4, 5, 6}, Visit()), "no effect called leg_ofset");
  EXPECT_DEATH(Apply("leg_offset", {1, 2}, Visit()), "leg_offset");
  EXPECT_DEATH(Apply("leg_thermal", {1}, Visit()), "without its reference_temperature");
}

}  // namespace
}  // namespace hexcal
