// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/tool_pose.h"

#include "config/input_error.h"
#include "measurement/marker_body.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::PoseNear;
using testing::RandomPose;
using testing::SeededByTest;

const Eigen::Vector3d kSigma(1e-4, 2e-4, 4e-4);  // of a marker coordinate along the tracker's axes

// Three markers whose centroid frame is the body's own: z = 0 plane, centroid at the origin, x
// along m1 -> m2.
Eigen::Matrix3d CentroidShape() {
  Eigen::Matrix3d shape;
  shape << -0.05, 0.07, -0.02, -0.03, -0.03, 0.06, 0, 0, 0;
  return shape;
}

MarkerBody RigidBody() {
  MarkerBody body;
  body.markers = {"a", "b", "c", "d"};
  body.p_in_body.resize(3, 4);
  body.p_in_body << 0.1, -0.05, -0.06, 0.0, 0.0, 0.08, -0.07, 0.02, 0.0, 0.01, 0.0, 0.06;
  return body;
}

MarkerBody CentroidBody() {
  MarkerBody body;
  body.is_centroid = true;
  body.markers = {"m1", "m2", "m3"};
  body.p_in_body.resize(3, 0);
  return body;
}

Eigen::Matrix3Xd Shape(const MarkerBody& body) {
  return body.is_centroid ? Eigen::Matrix3Xd(CentroidShape()) : body.p_in_body;
}

struct Truth {
  std::vector<Pose3d> tracker_from_world, world_from_tool;
};

// Readings of both bodies in every pose, frames times, with sigma = factor * kSigma.
template <typename Rng>
Dataset MakeDataset(Rng& rng,
                    const Truth& truth,
                    const MarkerBody& base,
                    const MarkerBody& tool,
                    int frames,
                    double factor) {
  Dataset dataset;
  dataset.measurement.emplace();
  Measurement& m = *dataset.measurement;
  m.kind = Measurement::Kind::kMarkers;
  m.bodies = {base, tool};
  m.marker_sigma = kSigma;
  for (int pose = 0; pose < static_cast<int>(truth.world_from_tool.size()); ++pose) {
    dataset.robot_poses.rows.push_back({std::to_string(pose), Pose3d(), {}, pose + 2});
    for (int frame = 0; frame < frames; ++frame)
      for (int b = 0; b < 2; ++b) {
        const Pose3d tracker_from_body =
            b == 0 ? truth.tracker_from_world[pose]
                   : truth.tracker_from_world[pose] * truth.world_from_tool[pose];
        const Eigen::Matrix3Xd shape = Shape(m.bodies[b]);
        for (int k = 0; k < shape.cols(); ++k) {
          const Eigen::Vector3d noise =
              kSigma.cwiseProduct(Eigen::Vector3d(testing::Normal(rng, 3)));
          m.readings.push_back(
              {pose,
               frame,
               static_cast<BodyId>(b),
               k,
               tracker_from_body * Eigen::Vector3d(shape.col(k)) + factor * noise});
        }
      }
  }
  return dataset;
}

template <typename Rng>
Truth RandomTruth(Rng& rng, int poses, bool tracker_is_static) {
  Truth truth;
  for (int i = 0; i < poses; ++i) {
    truth.tracker_from_world.push_back(tracker_is_static && i > 0 ? truth.tracker_from_world[0]
                                                                  : RandomPose(rng, 2.0));
    truth.world_from_tool.push_back(RandomPose(rng, 0.5));
  }
  return truth;
}

TEST(CentroidFrame, IsTheConstructionOfSection51) {
  auto rng = SeededByTest();
  for (const std::array<int, 2>& x_axis : {std::array<int, 2>{0, 1}, {1, 2}, {2, 0}}) {
    const Pose3d tracker_from_body = RandomPose(rng, 1.0);
    Eigen::Matrix3d seen;
    for (int k = 0; k < 3; ++k)
      seen.col(k) = tracker_from_body * Eigen::Vector3d(CentroidShape().col(k));
    const Pose3d frame = CentroidFrame(seen, Eigen::Matrix3d::Ones(), x_axis).a_from_b;
    EXPECT_TRUE(MatrixNear(frame.translation, seen.rowwise().mean(), 1e-15));
    const Eigen::Matrix3d axes = frame.rotation.toRotationMatrix();
    EXPECT_GT(axes.col(2).dot((seen.col(1) - seen.col(0)).cross(seen.col(2) - seen.col(0))), 0.0);
    EXPECT_TRUE(
        MatrixNear(axes.col(0), (seen.col(x_axis[1]) - seen.col(x_axis[0])).normalized(), 1e-14));
    EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
  }
}

TEST(CentroidFrame, CovarianceIsTheDerivativesOfTheConstruction) {
  auto rng = SeededByTest();
  const Pose3d tracker_from_body = RandomPose(rng, 1.0);
  Eigen::Matrix3d seen;
  for (int k = 0; k < 3; ++k)
    seen.col(k) = tracker_from_body * Eigen::Vector3d(CentroidShape().col(k));
  Eigen::Matrix3d sigma;
  sigma << 1, 2, 3, 2, 1, 4, 5, 1, 2;
  for (const std::array<int, 2>& x_axis : {std::array<int, 2>{0, 1}, {2, 1}}) {
    const Alignment frame = CentroidFrame(seen, sigma, x_axis);
    const Eigen::MatrixXd numeric = testing::NumericJacobian(
        [&](const Eigen::VectorXd& d) {
          const Eigen::Matrix3d moved = seen + Eigen::Map<const Eigen::Matrix3d>(d.data());
          return Minus(CentroidFrame(moved, sigma, x_axis).a_from_b, frame.a_from_b);
        },
        9);
    const Eigen::VectorXd variances =
        Eigen::Map<const Eigen::VectorXd>(sigma.data(), 9).array().square();
    const Matrix6d expected = numeric * variances.asDiagonal() * numeric.transpose();
    EXPECT_TRUE(MatrixNear(frame.covariance / expected.norm(), expected / expected.norm(), 1e-8));
  }
}

TEST(ToolPose, IsExactWithoutNoiseForEveryPairOfBodies) {
  auto rng = SeededByTest();
  for (const MarkerBody& base : {RigidBody(), CentroidBody()})
    for (const MarkerBody& tool : {RigidBody(), CentroidBody()})
      for (const bool is_static : {false, true}) {
        const Truth truth = RandomTruth(rng, 5, is_static);
        Dataset dataset = MakeDataset(rng, truth, base, tool, 2, 0.0);
        dataset.tracker.is_static = is_static;
        const ToolPoses poses = ComputeToolPoses(dataset);
        ASSERT_EQ(poses.poses.size(), 5u);
        EXPECT_TRUE(poses.has_covariance);
        EXPECT_EQ(poses.tracker_from_world.has_value(), is_static);
        for (int i = 0; i < 5; ++i)
          EXPECT_TRUE(
              PoseNear(poses.poses[i].world_from_tool, truth.world_from_tool[i], 1e-13, 1e-13));
      }
}

// Both bodies' noise, frames averaged, unequal sigmas along the tracker's axes: the reported
// covariance is the spread of repeats.
TEST(ToolPose, CovarianceIsTheSpreadOfRepeats) {
  auto rng = SeededByTest();
  for (const bool centroid : {false, true}) {
    const Truth truth = RandomTruth(rng, 3, false);
    const MarkerBody body = centroid ? CentroidBody() : RigidBody();
    const int draws = 6000;
    std::array<Matrix6d, 3> spread{Matrix6d::Zero(), Matrix6d::Zero(), Matrix6d::Zero()};
    ToolPoses poses;
    for (int i = 0; i < draws; ++i) {
      poses = ComputeToolPoses(MakeDataset(rng, truth, body, body, 3, 1.0));
      for (int p = 0; p < 3; ++p) {
        const Vector6d d = Minus(poses.poses[p].world_from_tool, truth.world_from_tool[p]);
        spread[p] += d * d.transpose() / draws;
      }
    }
    for (int p = 0; p < 3; ++p) {
      const Vector6d s = poses.poses[p].covariance.diagonal().cwiseSqrt().cwiseInverse();
      EXPECT_TRUE(MatrixNear(s.asDiagonal() * spread[p] * s.asDiagonal(),
                             s.asDiagonal() * poses.poses[p].covariance * s.asDiagonal(),
                             0.07));
    }
  }
}

TEST(ToolPose, FramesOfAPoseAreAveragedMarkerByMarker) {
  auto rng = SeededByTest();
  const Truth truth = RandomTruth(rng, 3, false);
  const Dataset one = MakeDataset(rng, truth, RigidBody(), RigidBody(), 1, 0.0);
  const Dataset four = MakeDataset(rng, truth, RigidBody(), RigidBody(), 4, 0.0);
  const Matrix6d ratio =
      ComputeToolPoses(one).poses[0].covariance - 4.0 * ComputeToolPoses(four).poses[0].covariance;
  EXPECT_LT(ratio.cwiseAbs().maxCoeff(),
            1e-3 * ComputeToolPoses(one).poses[0].covariance.cwiseAbs().maxCoeff());
}

TEST(ToolPose, APoseWithTooFewOrCollinearMarkersIsLeftOutAndNamed) {
  auto rng = SeededByTest();
  const Truth truth = RandomTruth(rng, 5, false);
  MarkerBody tool = RigidBody();
  tool.p_in_body.col(3) =
      0.5 * (tool.p_in_body.col(0) + tool.p_in_body.col(1));  // a, b, d on a line
  Dataset dataset = MakeDataset(rng, truth, RigidBody(), tool, 1, 0.0);
  auto& readings = dataset.measurement->readings;
  const auto drop = [&](int pose, BodyId body, std::vector<int> markers) {
    readings.erase(std::remove_if(readings.begin(),
                                  readings.end(),
                                  [&](const MarkerReading& r) {
                                    return r.pose == pose && r.body == body &&
                                           std::count(markers.begin(), markers.end(), r.marker) > 0;
                                  }),
                   readings.end());
  };
  drop(1, BodyId::kTool, {2});
  drop(2, BodyId::kBase, {0, 1});
  drop(3, BodyId::kTool, {0});
  const ToolPoses poses = ComputeToolPoses(dataset);
  ASSERT_EQ(poses.poses.size(), 3u);
  EXPECT_EQ(poses.poses[1].pose, 3);
  ASSERT_EQ(poses.warnings.size(), 2u);
  EXPECT_EQ(poses.warnings[0],
            "pose '1' is left out: of the tool body, the markers that were seen are collinear");
  EXPECT_EQ(
      poses.warnings[1],
      "pose '2' is left out: of the base body, only 2 of its 4 markers were seen, 3 are needed");
  drop(0, BodyId::kTool, {0, 1});
  EXPECT_THROW(ComputeToolPoses(dataset), InputError);
}

// A tracker that stands still: one base frame from all poses, and the base may be hidden in some.
TEST(ToolPose, AStaticTrackerNeedsTheBaseInSomePosesOnly) {
  auto rng = SeededByTest();
  const Truth truth = RandomTruth(rng, 4, true);
  Dataset dataset = MakeDataset(rng, truth, RigidBody(), RigidBody(), 1, 0.0);
  dataset.tracker.is_static = true;
  auto& readings = dataset.measurement->readings;
  readings.erase(
      std::remove_if(readings.begin(),
                     readings.end(),
                     [](const MarkerReading& r) { return r.pose > 1 && r.body == BodyId::kBase; }),
      readings.end());
  const ToolPoses poses = ComputeToolPoses(dataset);
  ASSERT_EQ(poses.poses.size(), 4u);
  EXPECT_TRUE(PoseNear(*poses.tracker_from_world, truth.tracker_from_world[0], 1e-13, 1e-13));
  EXPECT_TRUE(PoseNear(poses.poses[3].world_from_tool, truth.world_from_tool[3], 1e-13, 1e-13));
}

// Without a stated noise the common error is that of the readings' scatter: as when it is stated.
TEST(ToolPose, AStaticTrackersErrorIsToldByTheScatterOfTheBase) {
  auto rng = SeededByTest();
  const Truth truth = RandomTruth(rng, 200, true);
  for (const MarkerBody& body : {RigidBody(), CentroidBody()}) {
    Dataset dataset = MakeDataset(rng, truth, body, body, 2, 1.0);
    dataset.tracker.is_static = true;
    const double rms = kSigma.norm() / std::sqrt(3.0);
    dataset.measurement->marker_sigma = Eigen::Vector3d::Constant(rms);
    const Matrix6d stated = ComputeToolPoses(dataset).tracker_from_world_covariance;
    dataset.measurement->marker_sigma.reset();
    const ToolPoses poses = ComputeToolPoses(dataset);
    EXPECT_FALSE(poses.has_covariance);
    EXPECT_TRUE(poses.warnings.empty());
    const Vector6d scale = stated.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_TRUE(
        MatrixNear(scale.asDiagonal() * poses.tracker_from_world_covariance * scale.asDiagonal(),
                   scale.asDiagonal() * stated * scale.asDiagonal(),
                   0.1));
  }
}

TEST(ToolPose, AnErrorThatNothingTellsIsSaid) {
  auto rng = SeededByTest();
  const Truth truth = RandomTruth(rng, 4, true);
  Dataset dataset = MakeDataset(rng, truth, RigidBody(), RigidBody(), 1, 0.0);
  dataset.tracker.is_static = true;
  dataset.measurement->marker_sigma.reset();
  auto& readings = dataset.measurement->readings;
  readings.erase(
      std::remove_if(readings.begin(),
                     readings.end(),
                     [](const MarkerReading& r) { return r.pose > 0 && r.body == BodyId::kBase; }),
      readings.end());
  const ToolPoses poses = ComputeToolPoses(dataset);
  ASSERT_EQ(poses.warnings.size(), 1u);
  EXPECT_NE(poses.warnings[0].find("read only once"), std::string::npos);
}

}  // namespace
}  // namespace hexcal
