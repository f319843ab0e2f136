// SPDX-License-Identifier: BSD-3-Clause
// From recordings to a dataset: which rows belong together, which markers to which body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measurement/importers/assemble.h"
#include "measurement/importers/dataset_comments.h"
#include "measurement/importers/stops.h"
#include "measurement/tool_pose.h"
#include "testing/input_error_text.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::InputErrorText;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;
using testing::UniformVector;
using Vector = Eigen::Vector3d;

constexpr double kClose = 1e-12;
constexpr std::int64_t kSecond = 1'000'000'000;

// Four poses of a robot, and what a tracker at rest saw of two bodies of four markers each.
class Assembling : public ::testing::Test {
 protected:
  static constexpr std::size_t kRows = 4;

  void SetUp() override {
    std::mt19937_64 random = SeededByTest();
    const auto pose = [&random] {
      const Vector translation = UniformVector(random, 1.0);
      return Pose3d{translation, Exp(UniformVector(random, 0.5))};
    };
    world_from_base = pose();
    platform_from_tool = pose();
    tracker_from_world = pose();
    robot.path = "robot";
    robot.rows = kRows;
    robot.bodies.push_back({"robot", {}, {}});
    tracker.path = "tracker";
    tracker.rows = kRows;
    tracker.bodies = {{"frame", {"0x0A"}, {}}, {"probe", {"0x0B"}, {}}};
    for (int m = 0; m < 8; ++m) {
      tracker.markers.push_back({std::to_string(m % 4 + 1), {}});
      tracker.bodies[m / 4].markers.push_back(m);
    }
    for (std::size_t i = 0; i < kRows; ++i) {
      robot.bodies[0].poses.emplace_back(pose());
      robot.times.push_back(static_cast<std::int64_t>(i) * 10 * kSecond);
      tracker.times.push_back(robot.times[i] + 5 * kSecond + 1000);
      AddTrackerRow(*robot.bodies[0].poses[i]);
    }
    options.base = "0x0A";
    options.tool = "probe";
    options.pairing = Pairing::kRows;
  }

  void AddTrackerRow(const Pose3d& base_from_platform) {
    const Pose3d tool =
        tracker_from_world * world_from_base * base_from_platform * platform_from_tool;
    tracker.bodies[0].poses.emplace_back(tracker_from_world);
    tracker.bodies[1].poses.emplace_back(tool);
    for (int m = 0; m < 8; ++m)
      tracker.markers[m].points.emplace_back((m < 4 ? tracker_from_world : tool) *
                                             Vector(shape.col(m % 4)));
  }

  Dataset Make() const { return Assemble(robot, {tracker}, options).dataset; }
  std::string Error() const {
    return InputErrorText([this] { Make(); });
  }
  Pose3d ToolIn(std::size_t row) const {
    return world_from_base * *robot.bodies[0].poses[row] * platform_from_tool;
  }

  const Eigen::Matrix<double, 3, 4> shape =
      (Eigen::Matrix<double, 3, 4>() << 0, 0.1, 0, 0.05, 0, 0, 0.08, 0.03, 0, 0, 0, 0.02)
          .finished();
  Pose3d world_from_base, platform_from_tool, tracker_from_world;
  Recording robot, tracker;
  AssembleOptions options;
};

TEST_F(Assembling, TakesTheShapesFromPosesAndMarkers) {
  const Dataset dataset = Make();
  ASSERT_EQ(dataset.measurement->kind, Measurement::Kind::kMarkers);
  const MarkerBody& tool = dataset.measurement->bodies[1];
  EXPECT_THAT(tool.markers, ElementsAre("t1", "t2", "t3", "t4"));
  EXPECT_TRUE(MatrixNear(tool.p_in_body, shape, kClose));
  const ToolPoses poses = ComputeToolPoses(dataset);
  ASSERT_EQ(poses.poses.size(), kRows);
  for (std::size_t i = 0; i < kRows; ++i)
    EXPECT_TRUE(PoseNear(poses.poses[i].world_from_tool, ToolIn(i), 1e-9, 1e-9));
}

TEST_F(Assembling, TakesPosesWhereAskedTo) {
  options.kind = ImportKind::kPoses;
  const Dataset dataset = Make();
  ASSERT_EQ(dataset.measurement->kind, Measurement::Kind::kPoses);
  for (std::size_t i = 0; i < kRows; ++i)
    EXPECT_TRUE(PoseNear(dataset.measurement->poses[i].world_from_tool, ToolIn(i), kClose, kClose));
  options.base = "tracker";
  EXPECT_TRUE(PoseNear(Make().measurement->poses[0].world_from_tool,
                       tracker_from_world * ToolIn(0),
                       kClose,
                       kClose));
}

TEST_F(Assembling, InvertsWhatIsStatedTheOtherWayRound) {
  const Dataset straight = Make();
  const Pose3d tool = ToolIn(1);
  for (std::optional<Pose3d>& pose : robot.bodies[0].poses) pose = pose->Inverse();
  for (RecordedBody& body : tracker.bodies)
    for (std::optional<Pose3d>& pose : body.poses) pose = pose->Inverse();
  options.robot_inverse = options.measured_inverse = true;
  const Dataset inverted = Make();
  EXPECT_TRUE(PoseNear(inverted.robot_poses.rows[2].base_from_platform,
                       straight.robot_poses.rows[2].base_from_platform,
                       kClose,
                       kClose));
  EXPECT_TRUE(MatrixNear(inverted.measurement->bodies[1].p_in_body, shape, kClose));
  options.kind = ImportKind::kPoses;
  EXPECT_TRUE(PoseNear(Make().measurement->poses[1].world_from_tool, tool, kClose, kClose));
}

// By the number of the frame where the file has it, else by time; by label only where each row is a
// pose of its own.
TEST_F(Assembling, WarnsOfRowsThatAreThereTwice) {
  EXPECT_THAT(Make().warnings, ::testing::IsEmpty());
  tracker.lines = {5, 6, 7, 8};
  tracker.times[2] = tracker.times[1];
  EXPECT_THAT(Make().warnings,
              ElementsAre("tracker: line 7 has the time of line 6: is a reading there twice?"));
  tracker.frames = {1, 2, 3, 4};
  EXPECT_THAT(Make().warnings, ::testing::IsEmpty());
  tracker.frames = {17, 2, 17, 17};
  tracker.labels = {"a", "b", "c", "b"};
  const char* frames =
      "tracker: line 7 has the frame number 17 of line 5, another row that of an earlier one: is a "
      "reading there twice?";
  EXPECT_THAT(Make().warnings, ElementsAre(frames));
  robot.labels = tracker.labels;
  robot.labels[3] = "d";
  for (const Pairing pairing : {Pairing::kTime, Pairing::kLabels, Pairing::kRows}) {
    options.pairing = pairing;
    options.window = 10.0;
    EXPECT_THAT(Make().warnings, ElementsAre(frames)) << static_cast<int>(pairing);
  }
  tracker.frames.clear();
  tracker.times.clear();
  EXPECT_THAT(
      Make().warnings,
      ElementsAre("tracker: line 8 has the label 'b' of line 6: is a reading there twice?"));
  options.pairing = Pairing::kLabels;
  EXPECT_THAT(Make().warnings, ::testing::IsEmpty());
}

// In a body that is used, with the line where there is one.
TEST_F(Assembling, RefusesWhatIsAbsurdlyFarAway) {
  tracker.markers.push_back(
      {"other", std::vector<std::optional<Vector>>(kRows, Vector(1e25, 0, 0))});
  EXPECT_EQ(Error(), "(no exception)");
  tracker.markers[5].points[2] = Vector(0.0, -1e25, 0.0);
  const char* expected =
      "expected a length of at most 1000 km (--missing_value=X says what stands for not seen)";
  EXPECT_EQ(Error(),
            std::string("tracker: found a coordinate of '2' of 1e+25 m in row 3, ") + expected);
  tracker.lines = {5, 6, 7, 8};
  EXPECT_EQ(Error(), std::string("tracker:7: found a coordinate of '2' of 1e+25 m, ") + expected);
  tracker.bodies[1].poses[1]->translation.z() = 1.1e6;
  EXPECT_THAT(Error(), HasSubstr("tracker:6: found a coordinate of 'probe' of 1.1e+06 m"));
  robot.lines = {1, 2, 3, 4};
  robot.bodies[0].poses[3]->translation.x() = -1e7;
  EXPECT_THAT(Error(), HasSubstr("robot:4: found a coordinate of 'robot' of 1e+07 m"));
}

TEST_F(Assembling, TakesThreeMarkersByNameWithTheirOwnFrame) {
  tracker.bodies.clear();
  for (int m = 0; m < 8; ++m) tracker.markers[m].name = std::string(1, static_cast<char>('A' + m));
  options.base = "B,A,D";
  options.tool = "E, F,G";
  const Dataset dataset = Make();
  EXPECT_TRUE(dataset.measurement->bodies[0].is_centroid);
  EXPECT_THAT(dataset.measurement->bodies[0].markers, ElementsAre("B", "A", "D"));
  EXPECT_TRUE(MatrixNear(
      dataset.measurement->readings[0].p_in_tracker, *tracker.markers[1].points[0], kClose));
  options.tool = "E,F,G,H";
  EXPECT_THAT(Error(), HasSubstr("--tool_body=FILE"));
  options.tool_shape = StatedShape{"t.rig", {"1", "2", "3", "4"}, shape};
  EXPECT_TRUE(MatrixNear(Make().measurement->bodies[1].p_in_body, shape, kClose));
  options.tool_shape->points.col(0).swap(options.tool_shape->points.col(1));
  EXPECT_THAT(Make().warnings, ::testing::Contains(HasSubstr("in the same order?")));
  options.tool_shape = StatedShape{"t.rig", {"1", "2", "3"}, shape.leftCols<3>()};
  EXPECT_THAT(Error(), HasSubstr("t.rig: found 3 markers, expected 4"));
  options.tool = "E,F,Q";
  EXPECT_THAT(Error(), HasSubstr("none of them 'E,F,Q'"));
  options.tool = "E,F,E";
  EXPECT_THAT(Error(), HasSubstr("--tool=A,B,C"));
}

TEST_F(Assembling, PairsByTimeByTheRobotsClockAndTheOffset) {
  options.pairing = Pairing::kTime;
  EXPECT_THAT(Error(), HasSubstr("--time_offset=S"));
  options.time_offset = 5.0;
  // Out of order, and one of them twice.
  std::swap(tracker.times[0], tracker.times[3]);
  for (int m = 0; m < 8; ++m) std::swap(tracker.markers[m].points[0], tracker.markers[m].points[3]);
  const Dataset dataset = Make();
  EXPECT_EQ(dataset.measurement->readings.size(), 8 * kRows);
  for (const MarkerReading& reading : dataset.measurement->readings) {
    const Pose3d frame = reading.body == BodyId::kBase
                             ? tracker_from_world
                             : tracker_from_world * ToolIn(static_cast<std::size_t>(reading.pose));
    EXPECT_TRUE(
        MatrixNear(reading.p_in_tracker, frame * Vector(shape.col(reading.marker)), kClose));
  }
  EXPECT_THAT(dataset.robot_poses.covariates[0].values, ElementsAre(0.0, 10.0, 20.0, 30.0));
  options.window = 1e-7;  // the clocks differ by 1 us
  EXPECT_THAT(Error(), HasSubstr("some within --window"));
}

// A log of the robot at 10 Hz: three stops of 2 s, 1 s of motion between them, a stop of 0.5 s.
TEST_F(Assembling, MakesPosesOfTheStopsInALog) {
  Recording log = robot;
  log.rows = 0;
  log.times.clear();
  log.bodies[0].poses.clear();
  const auto add = [&log](const Pose3d& pose) {
    log.bodies[0].poses.emplace_back(pose);
    log.times.push_back(static_cast<std::int64_t>(log.rows++) * kSecond / 10);
  };
  const Vector6d jitter = Vector6d::Constant(1e-6);
  for (int stop = 0; stop < 4; ++stop) {
    const Pose3d pose = *robot.bodies[0].poses[static_cast<std::size_t>(stop)];
    for (int i = 0; i < (stop < 3 ? 20 : 5); ++i) add(i % 2 == 0 ? pose : Plus(pose, jitter));
    for (int i = 0; i < 10; ++i) {
      Vector6d moved = Vector6d::Zero();
      moved[1] = 0.001 * (i + 1);
      add(Plus(pose, moved));
    }
  }
  const Recording stops = FindStops(log, 1.0);
  ASSERT_EQ(stops.rows, 3u);
  EXPECT_THAT(stops.spans,
              ElementsAre(std::make_pair(0L, 1900000000L),
                          std::make_pair(3000000000L, 4900000000L),
                          std::make_pair(6000000000L, 7900000000L)));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_TRUE(PoseNear(*stops.bodies[0].poses[i], *robot.bodies[0].poses[i], 2e-6, 2e-6));

  // Readings of the tracker at 0.3 s (settling), 1.8 s, 2.5 s (moving), 3.5 s of its own clock.
  options.pairing = Pairing::kTime;
  options.time_offset = 100.0;
  tracker.times = {100300000000, 101800000000, 102500000000, 103500000000};
  const Dataset dataset = Assemble(stops, {tracker}, options).dataset;
  EXPECT_EQ(dataset.robot_poses.rows.size(), 3u);
  ASSERT_EQ(dataset.measurement->readings.size(), 16u);
  EXPECT_EQ(dataset.measurement->readings.front().pose, 0);
  EXPECT_TRUE(MatrixNear(
      dataset.measurement->readings.front().p_in_tracker, *tracker.markers[0].points[1], kClose));
  EXPECT_EQ(dataset.measurement->readings.back().pose, 1);

  EXPECT_THAT(InputErrorText([&] { FindStops(log, 10.0); }),
              HasSubstr("no stop of 10 s or longer"));
  std::swap(log.times[3], log.times[4]);
  EXPECT_THAT(InputErrorText([&] { FindStops(log, 1.0); }), HasSubstr("rising times"));
  log.times.clear();
  EXPECT_THAT(InputErrorText([&] { FindStops(log, 1.0); }), HasSubstr("for --stops"));
}

TEST_F(Assembling, KeepsReadingsOfOnePoseAsFrames) {
  Recording again = tracker;
  for (RecordedMarker& marker : again.markers)
    for (std::optional<Vector>& point : marker.points) *point += Vector(1e-5, 0, 0);
  options.frames = 2;
  // Row by row: the rows of the first file belong to the first two poses.
  EXPECT_THAT(InputErrorText([&] { Assemble(robot, {tracker}, options); }),
              HasSubstr("2 of the tracker for each of the robot"));
  options.frames = 1;
  options.pairing = Pairing::kFiles;
  robot.rows = 2;
  robot.bodies[0].poses.resize(2);
  const Dataset dataset = Assemble(robot, {tracker, again}, options).dataset;
  EXPECT_THAT(dataset.measurement->frame_labels, ElementsAre("1", "2", "3", "4"));
  EXPECT_EQ(dataset.measurement->readings.size(), 8 * 8u);
  EXPECT_EQ(dataset.measurement->readings.back().pose, 1);
  EXPECT_EQ(dataset.measurement->readings.back().frame, 3);
}

TEST_F(Assembling, AveragesPosesOfOnePose) {
  options.kind = ImportKind::kPoses;
  options.pairing = Pairing::kFiles;
  options.base = "tracker";
  robot.rows = 1;
  robot.bodies[0].poses.resize(1);
  tracker.rows = 2;
  const Pose3d mean = *tracker.bodies[1].poses[0];
  const Vector6d d = 1e-3 * (Vector6d() << 1, -2, 3, 0.4, 0.5, -0.6).finished();
  tracker.bodies[1].poses[0] = Plus(mean, d);
  tracker.bodies[1].poses[1] = Plus(mean, Vector6d(-d));
  tracker.bodies[1].poses[1]->rotation.coeffs() *= -1.0;  // the same rotation
  EXPECT_TRUE(PoseNear(Make().measurement->poses.at(0).world_from_tool, mean, 1e-12, 1e-9));
}

TEST_F(Assembling, PairsByLabels) {
  options.pairing = Pairing::kLabels;
  EXPECT_THAT(Error(), HasSubstr("robot: found no labels"));
  robot.labels = {"a", "b", "c", "d"};
  tracker.labels = {"d", "c", "b", "a"};
  const Dataset dataset = Make();
  EXPECT_EQ(dataset.measurement->readings.front().pose, 0);
  EXPECT_TRUE(MatrixNear(
      dataset.measurement->readings.front().p_in_tracker, *tracker.markers[0].points[3], kClose));
  EXPECT_EQ(dataset.robot_poses.rows[3].label, "d");
  tracker.labels[2] = "x";
  EXPECT_THAT(Error(), HasSubstr("found the label 'x', expected one that robot has"));
  robot.labels[1] = "a";
  EXPECT_THAT(Error(), HasSubstr("found the label 'a' a second time"));
}

TEST_F(Assembling, LeavesUnseenReadingsOut) {
  tracker.markers[5].points[1].reset();
  tracker.bodies[1].poses[2].reset();
  EXPECT_EQ(Make().measurement->readings.size(), 8 * kRows - 1);
  options.kind = ImportKind::kPoses;
  EXPECT_EQ(Make().measurement->poses.size(), kRows - 1);
}

TEST_F(Assembling, AsksForWhatIsNotSaid) {
  options.pairing.reset();
  EXPECT_THAT(Error(), HasSubstr("4 rows in one file of the tracker and 4 rows of the robot"));
  options.base.clear();
  EXPECT_THAT(Error(), HasSubstr("which of them is the base: --base=NAME of a body"));
  options.base = "frame";
  options.tool = "nothing";
  EXPECT_THAT(Error(), HasSubstr("the bodies 'frame', 'probe'"));
  robot.bodies.push_back({"second", {}, {}});
  EXPECT_THAT(InputErrorText([&] { Assemble(robot, {}, options); }),
              HasSubstr("expected the poses of one robot"));
}

TEST_F(Assembling, TakesOnlyHostileNamesThatAreTamed) {
  tracker.bodies[1].name = "x\nmeasurement: {kind: none}\n\x1b[31m\"";
  tracker.markers[4].name = "=cmd,\"1\"\n";
  const Assembled assembled = Assemble(robot, {tracker}, [this] {
    AssembleOptions hostile = options;
    hostile.tool = "0x0B";
    return hostile;
  }());
  EXPECT_EQ(assembled.dataset.measurement->bodies[1].markers[0], "=cmd__1__");
  const std::string text = WithComments("\nmeasurement:\n", assembled);
  for (std::size_t at = 0; (at = text.find('\n', at)) + 1 < text.size(); ++at)
    EXPECT_TRUE(text[at + 1] == '#' || text.compare(at + 1, 12, "measurement:") == 0) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace hexcal
