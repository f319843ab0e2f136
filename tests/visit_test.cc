// SPDX-License-Identifier: BSD-3-Clause
#include "model/visit.h"

#include <cmath>

#include "model/predict.h"
#include "testing/datasets.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;

Pose3d Level(double x, double y, double z, double yaw = 0.0) {
  return {Eigen::Vector3d(x, y, z), Exp(Eigen::Vector3d(0, 0, yaw))};
}

// Base and platform joints on the same circle: legs are vertical at a level pose.
HexapodGeometry UprightHexapod() {
  HexapodGeometry hexapod = testing::SmallHexapod();
  hexapod.platform_joints_in_platform = hexapod.base_joints_in_base;
  hexapod.home = Level(0, 0, 0.2);
  return hexapod;
}

std::vector<Visit> VisitsOf(const HexapodGeometry& hexapod, const std::vector<Pose3d>& poses) {
  return MakeVisits(testing::DatasetOfPoses(poses), &hexapod, poses);
}

void AddColumn(Dataset* dataset, const std::string& name, const std::vector<double>& values) {
  dataset->robot_poses.covariates.push_back({name, Unit(), values});
}

TEST(HomePose, IsTheHexapodsOwnWhereItSays) {
  const HexapodGeometry hexapod = UprightHexapod();
  EXPECT_TRUE(PoseNear(HomePose(&hexapod, {Level(0, 0, 0.3)}), Level(0, 0, 0.2), 0, 0));
}

TEST(HomePose, IsElseTheMeanOfThePoses) {
  const HexapodGeometry hexapod = testing::SmallHexapod();
  const std::vector<Pose3d> poses = {Level(0.01, 0, 0.2, 0.1), Level(0.03, -0.02, 0.22, 0.3)};
  EXPECT_TRUE(PoseNear(HomePose(&hexapod, poses), Level(0.02, -0.01, 0.21, 0.2), 1e-16, 1e-15));
}

// Turning and moving the whole robot moves the mean with it; the order does not matter.
TEST(HomePose, FollowsTheRobotAndForgetsTheOrder) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::SmallHexapod();
  const Pose3d moved_from_base = testing::RandomPose(rng, 1.0);
  std::vector<Pose3d> poses, moved;
  for (int i = 0; i < 7; ++i) poses.push_back(testing::RandomWorkspacePose(rng, 0.2, 0.5));
  for (const Pose3d& pose : poses) moved.insert(moved.begin(), moved_from_base * pose);
  const Pose3d home = HomePose(&hexapod, poses);
  EXPECT_TRUE(PoseNear(HomePose(&hexapod, moved), moved_from_base * home, 1e-14, 1e-14));
}

TEST(MakeVisits, OfADatasetThatTellsNothingKnowsThePoseAlone) {
  const std::vector<Pose3d> poses = {Level(0, 0, 0.2), Level(0, 0.01, 0.2)};
  const Dataset dataset = testing::DatasetOfPoses(poses);
  const std::vector<Visit> visits = MakeVisits(dataset, nullptr, poses);
  ASSERT_EQ(visits.size(), 2u);
  EXPECT_EQ(visits[1].row, 1);
  EXPECT_TRUE(PoseNear(visits[1].base_from_platform, poses[1], 0, 0));
  EXPECT_TRUE(std::isnan(visits[1].time) && std::isnan(visits[1].temperature));
  EXPECT_TRUE(std::isnan(visits[1].payload) && visits[1].gravity_in_base.hasNaN());
  EXPECT_TRUE(visits[1].velocity.hasNaN());
  EXPECT_EQ(visits[1].payload_centre, Eigen::Vector3d::Zero());
  EXPECT_EQ(visits[1].lengths, LegLengths::Zero());
  EXPECT_EQ(visits[1].plates, nullptr);
}

TEST(MakeVisits, TakesTheCovariatesByTheirNames) {
  const std::vector<Pose3d> poses = {Level(0, 0, 0.2), Level(0, 0.01, 0.2)};
  Dataset dataset = testing::DatasetOfPoses(poses);
  dataset.gravity_in_base = Eigen::Vector3d(0, 0.6, -0.8);
  double value = 1.0;
  for (const char* name :
       {"time", "temperature", "payload", "payload_z", "vx", "vy", "vz", "wx", "wy", "wz"}) {
    AddColumn(&dataset, name, {value, 10 * value});
    value += 1.0;
  }
  const std::vector<Visit> visits = MakeVisits(dataset, nullptr, poses);
  EXPECT_EQ(visits[0].time, 1.0);
  EXPECT_EQ(visits[1].time, 10.0);
  EXPECT_EQ(visits[1].temperature, 20.0);
  EXPECT_EQ(visits[1].payload, 30.0);
  EXPECT_EQ(visits[1].payload_centre, Eigen::Vector3d(0, 0, 40.0));
  Vector6d velocity;
  velocity << 50, 60, 70, 80, 90, 100;
  EXPECT_EQ(visits[1].velocity, velocity);
  EXPECT_EQ(visits[1].gravity_in_base, Eigen::Vector3d(0, 0.6, -0.8));
}

TEST(MakeVisits, KnowsLengthsDirectionsAndJacobianOfTheNominalLegs) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const Pose3d pose = testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.5);
  const Visit visit = VisitsOf(hexapod, {pose})[0];
  EXPECT_TRUE(MatrixNear(visit.lengths, InverseKinematics(hexapod, pose), 0.0));
  EXPECT_TRUE(MatrixNear(visit.leg_jacobian, LegJacobian(hexapod, pose), 0.0));
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d lower = hexapod.base_joints_in_base.col(i);
    const Eigen::Vector3d joint = hexapod.platform_joints_in_platform.col(i);
    const Eigen::Vector3d reached = lower + visit.lengths[i] * visit.legs_in_base.col(i);
    EXPECT_TRUE(MatrixNear(reached, pose * joint, 1e-15));
  }
}

TEST(MakeVisits, TakesRecordedLegsAsTheyAre) {
  const HexapodGeometry hexapod = UprightHexapod();
  Dataset dataset = testing::DatasetOfLegs(hexapod, {Level(0, 0, 0.21)});
  dataset.robot_poses.rows[0].leg_lengths[2] = 0.25;
  const std::vector<Pose3d> reported = {Level(0, 0, 0.21)};
  const Visit visit = MakeVisits(dataset, &hexapod, reported)[0];
  EXPECT_EQ(visit.lengths[2], 0.25);
  EXPECT_NEAR(visit.lengths[3], 0.21, 1e-16);
}

TEST(MakeVisits, CountsTheFirstMoveFromHomeAndTheOthersFromTheVisitBefore) {
  const std::vector<Visit> visits =
      VisitsOf(UprightHexapod(),
               {Level(0, 0, 0.19), Level(0, 0, 0.21), Level(0, 0, 0.21), Level(0, 0, 0.2)});
  EXPECT_TRUE(MatrixNear(visits[0].home_lengths, LegLengths::Constant(0.2), 1e-16));
  EXPECT_TRUE(MatrixNear(visits[0].last_move, LegLengths::Constant(-0.01), 1e-16));
  EXPECT_TRUE(MatrixNear(visits[1].last_move, LegLengths::Constant(0.02), 1e-16));
  EXPECT_EQ(visits[2].last_move, LegLengths::Zero());
  EXPECT_EQ(visits[0].direction, -Vector6d::Ones());
  EXPECT_EQ(visits[1].direction, Vector6d::Ones());
  EXPECT_EQ(visits[2].direction, Vector6d::Ones());  // it stood still
  EXPECT_EQ(visits[3].direction, -Vector6d::Ones());
}

TEST(MakeVisits, BelievesADirectionColumn) {
  const std::vector<Pose3d> poses = {Level(0, 0, 0.21), Level(0, 0, 0.22)};
  Dataset dataset = testing::DatasetOfPoses(poses);
  AddColumn(&dataset, "direction_3", {-1, 0});
  const HexapodGeometry hexapod = UprightHexapod();
  const std::vector<Visit> visits = MakeVisits(dataset, &hexapod, poses);
  Vector6d direction;
  direction << 1, 1, -1, 1, 1, 1;
  EXPECT_EQ(visits[0].direction, direction);
  direction[2] = 0;
  EXPECT_EQ(visits[1].direction, direction);
}

TEST(LegRoll, StaysInPureTranslationAlongTheLegs) {
  const std::vector<Visit> visits = VisitsOf(UprightHexapod(), {Level(0, 0, 0.25)});
  EXPECT_TRUE(MatrixNear(visits[0].roll, Vector6d::Zero(), 1e-15));
}

// The platform turns right-handed about the vertical, and so do the upper joints about vertical
// legs.
TEST(LegRoll, IsTheYawWhereLegsStayVertical) {
  HexapodGeometry hexapod = UprightHexapod();
  hexapod.base_joints_in_base *= 1e-6;  // legs so near to the axis that they stay vertical
  hexapod.platform_joints_in_platform *= 1e-6;
  const std::vector<Visit> visits =
      VisitsOf(hexapod, {Level(0, 0, 0.2, 0.3), Level(0, 0, 0.22, -2.5)});
  EXPECT_TRUE(MatrixNear(visits[0].roll, Vector6d::Constant(0.3), 1e-6));
  EXPECT_TRUE(MatrixNear(visits[1].roll, Vector6d::Constant(-2.5), 1e-6));
}

// Joint by joint as a mechanic would: lay both axes into the plane across the leg, measure from one
// to the other.
TEST(LegRoll, IsTheAngleBetweenTheProjectedAxes) {
  std::mt19937_64 rng = SeededByTest();
  HexapodGeometry hexapod = testing::LargeHexapod();
  hexapod.base_axes_in_base = Matrix36d::Zero();
  hexapod.platform_axes_in_platform = Matrix36d::Zero();
  for (int i = 0; i < kNumLegs; ++i) {
    hexapod.base_axes_in_base->col(i) = testing::Normal(rng, 3).normalized();
    hexapod.platform_axes_in_platform->col(i) = testing::Normal(rng, 3).normalized();
  }
  const Plates plates = PlatesOf(hexapod);
  const Pose3d pose = testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.5);
  const Vector6d roll = LegRoll(plates, pose);
  const Matrix36d legs = LegsInBase(plates, pose);
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d along = legs.col(i);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along * along.transpose();
    const Eigen::Vector3d lower = (across * hexapod.base_axes_in_base->col(i)).normalized();
    const Eigen::Vector3d upper =
        (across * (pose.rotation.toRotationMatrix() * hexapod.platform_axes_in_platform->col(i)))
            .normalized();
    const Eigen::Vector3d turn = roll[i] * along;
    EXPECT_TRUE(MatrixNear(Exp(turn) * lower, upper, 1e-14));
  }
}

TEST(MakeVisits, CountsRollFromHomeAndTellsHomesOwn) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const Pose3d home = Level(0.01, 0.02, 0.5, 0.1);
  HexapodGeometry with_home = hexapod;
  with_home.home = home;
  const Visit at_home = VisitsOf(with_home, {home})[0];
  EXPECT_TRUE(MatrixNear(at_home.roll, Vector6d::Zero(), 0.0));
  const Pose3d pose = testing::RandomWorkspacePose(rng, testing::kLargeHeight, 0.3);
  const Visit visit = VisitsOf(with_home, {pose})[0];
  EXPECT_TRUE(MatrixNear(visit.roll + visit.home_roll, LegRoll(PlatesOf(hexapod), pose), 1e-14));
}

TEST(PlatesOf, TakesRadialAxesWhereNoneAreGiven) {
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const Plates plates = PlatesOf(hexapod);
  for (int i = 0; i < kNumLegs; ++i) {
    const double angle = 2.0 * M_PI / 3.0 * (i / 2) + (i % 2 == 0 ? -0.85 : 0.85);
    const Eigen::Vector3d radial(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_TRUE(MatrixNear(plates.platform_axes.col(i), radial, 1e-14));
    EXPECT_TRUE(MatrixNear(plates.platform_radial.col(i), radial, 1e-14));
  }
  // These joints lie 0.01 m apart in height: radial is along the plane nearest to them.
  EXPECT_TRUE(MatrixNear(plates.base_radial.colwise().norm(), Vector6d::Ones().transpose(), 1e-15));
  const Matrix36d spread = plates.base_joints.colwise() - plates.base_joints.rowwise().mean();
  EXPECT_GT((plates.base_radial.cwiseProduct(spread)).colwise().sum().minCoeff(), 0.38);
}

TEST(MakeVisits, KnowsTheAnglesOfLegsToTheirJointsAxes) {
  HexapodGeometry hexapod = UprightHexapod();
  hexapod.base_axes_in_base = Eigen::Vector3d(0.6, 0.0, 0.8).replicate<1, 6>();
  hexapod.platform_axes_in_platform = Eigen::Vector3d(0.0, 1.0, 0.0).replicate<1, 6>();
  const Eigen::Vector3d tilt(0.5, 0, 0);
  const std::vector<Visit> visits =
      VisitsOf(hexapod, {Level(0, 0, 0.2), Pose3d{Eigen::Vector3d(0, 0, 50.0), Exp(tilt)}});
  EXPECT_TRUE(MatrixNear(visits[0].base_axis_cosine, Vector6d::Constant(0.8), 1e-15));
  EXPECT_TRUE(MatrixNear(visits[0].platform_axis_cosine, Vector6d::Zero(), 1e-15));
  // Fifty metres up the legs are all but vertical and the platform's axis climbs by the tilt.
  EXPECT_TRUE(MatrixNear(visits[1].platform_axis_cosine, Vector6d::Constant(std::sin(0.5)), 5e-3));
}

TEST(VisitSequence, GivesTheSameVisitsOneByOne) {
  std::mt19937_64 rng = SeededByTest();
  const HexapodGeometry hexapod = testing::SmallHexapod();
  std::vector<Pose3d> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(testing::RandomWorkspacePose(rng, 0.2, 0.3));
  const Dataset dataset = testing::DatasetOfPoses(poses);
  const std::vector<Visit> visits = MakeVisits(dataset, &hexapod, poses);
  VisitSequence sequence(dataset, &hexapod, poses);
  for (int row = 0; row < 5; ++row) {
    const Visit visit = sequence.Next();
    EXPECT_EQ(visit.row, row);
    EXPECT_EQ(visit.last_move, visits[row].last_move);
    EXPECT_EQ(visit.roll, visits[row].roll);
  }
  EXPECT_DEATH(sequence.Next(), "");
}

TEST(DriversOf, NamesWhatIsThere) {
  Dataset dataset = testing::DatasetOfPoses({Level(0, 0, 0.2)});
  Drivers drivers = DriversOf(dataset);
  EXPECT_FALSE(drivers.legs || drivers.time || drivers.temperature || drivers.payload);
  EXPECT_FALSE(drivers.gravity || drivers.velocity || drivers.order || drivers.markers);
  dataset = testing::DatasetOfPoses({Level(0, 0, 0.2), Level(0, 0, 0.21)});
  dataset.hexapod = testing::SmallHexapod();
  dataset.gravity_in_base = Eigen::Vector3d(0, 0, -1);
  for (const char* name : {"time", "temperature", "payload", "vx", "vy", "vz", "wx", "wy"})
    AddColumn(&dataset, name, {0.0, 1.0});
  drivers = DriversOf(dataset);
  EXPECT_TRUE(drivers.legs && drivers.time && drivers.temperature && drivers.payload);
  EXPECT_TRUE(drivers.gravity && drivers.order);
  EXPECT_FALSE(drivers.velocity);  // wz is missing
  AddColumn(&dataset, "wz", {0.0, 1.0});
  EXPECT_TRUE(DriversOf(dataset).velocity);
  dataset.measurement = Measurement();
  EXPECT_FALSE(DriversOf(dataset).markers);
  dataset.measurement->kind = Measurement::Kind::kMarkers;
  EXPECT_TRUE(DriversOf(dataset).markers);
}

}  // namespace
}  // namespace hexcal
