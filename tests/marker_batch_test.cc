// SPDX-License-Identifier: BSD-3-Clause
// The likelihood of marker readings with its nuisances eliminated: derivatives, and agreement with
// the plain problem in which they are parameters.
#include "residuals/marker_batch.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "estimator/calibrate.h"
#include "estimator/marker_reference.h"
#include "estimator/marker_solver.h"
#include "testing/bits.h"
#include "testing/marker_scenes.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::BlockDifference;
using testing::DrawMarkers;
using testing::MarkerScene;
using testing::MatrixNear;
using testing::SeededByTest;
using Blocks = ParameterBlocks;

// All that changes which unknowns there are.
std::vector<MarkerScene> AllScenes() {
  std::vector<MarkerScene> scenes;
  for (const bool is_static : {false, true})
    for (const bool base : {false, true})
      for (const bool tool : {false, true})
        for (const double robot_noise : {0.0, 1e-4}) {
          MarkerScene scene;
          scene.tracker_is_static = is_static;
          scene.centroid = {base, tool};
          scene.robot_noise = robot_noise;
          scenes.push_back(scene);
        }
  return scenes;
}

std::string Name(const MarkerScene& s) {
  return fmt::format("tracker {}, base {}, tool {}, robot noise {}",
                     s.tracker_is_static ? "static" : "moving",
                     s.centroid[0] ? "centroid" : "rigid",
                     s.centroid[1] ? "centroid" : "rigid",
                     s.robot_noise);
}

struct Drawn {
  testing::MarkerTruth truth;
  Observations observations;
  MarkerObservations markers;
};

template <typename Rng>
Drawn DrawScene(Rng& rng, const MarkerScene& scene, double noise) {
  Drawn drawn;
  drawn.truth = testing::MakeMarkerTruth(rng, scene);
  const Dataset dataset = DrawMarkers(drawn.truth, 1, noise);
  drawn.observations = MakeObservations(dataset);
  drawn.markers = MakeMarkerObservations(dataset, drawn.observations);
  return drawn;
}

Blocks Solved(const MarkerBatch& batch, Blocks start) {
  EXPECT_TRUE(SolveStreamed(batch, {}, &start).converged);
  return start;
}

Blocks StartAt(const MarkerData& data, const BaseAndTool& mounts) {
  return MarkerLayout(data).Start(data, mounts.world_from_base, mounts.platform_from_tool);
}

TEST(MarkerBatch, ItsGradientIsThatOfTheProfileCost) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : AllScenes()) {
    SCOPED_TRACE(Name(scene));
    const Drawn d = DrawScene(rng, scene, 1.0);
    const MarkerBatch batch(d.markers.data, scene.sigma);
    const Blocks start = StartAt(d.markers.data, d.truth.mounts);
    // Some sigmas away from the best fit, where the gradient is large.
    const Blocks point =
        Moved(start, 1e-3 * testing::Normal(rng, MarkerLayout(d.markers.data).size));
    const NormalEquations at = Evaluate(batch, point);
    const auto cost = [&](const Eigen::VectorXd& motion) {
      const Blocks moved = Moved(point, motion);
      return Eigen::VectorXd::Constant(1, 0.5 * Evaluate(batch, moved).squared_norm);
    };
    const Eigen::VectorXd numeric =
        testing::NumericJacobian(cost, static_cast<int>(at.gradient.size()), 1e-6).transpose();
    // In sigmas of the parameters.
    const Eigen::VectorXd scale = at.normal.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_TRUE(MatrixNear(Eigen::VectorXd(scale.cwiseProduct(at.gradient)),
                           Eigen::VectorXd(scale.cwiseProduct(numeric)),
                           1e-5));
    EXPECT_GT(scale.cwiseProduct(at.gradient).norm(), 1.0);
  }
}

// At a perfect fit the Schur complement is the whole second derivative.
TEST(MarkerBatch, ItsNormalMatrixIsTheSecondDerivativeAtAPerfectFit) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : AllScenes()) {
    SCOPED_TRACE(Name(scene));
    const Drawn d = DrawScene(rng, scene, 0.0);
    const MarkerBatch batch(d.markers.data, scene.sigma);
    const Blocks point = StartAt(d.markers.data, d.truth.mounts);
    const NormalEquations at = Evaluate(batch, point);
    const auto gradient = [&](const Eigen::VectorXd& motion) {
      return Evaluate(batch, Moved(point, motion)).gradient;
    };
    const Eigen::MatrixXd numeric =
        testing::NumericJacobian(gradient, static_cast<int>(at.gradient.size()), 1e-5);
    const Eigen::VectorXd scale = at.normal.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_TRUE(MatrixNear(scale.asDiagonal() * at.normal * scale.asDiagonal(),
                           scale.asDiagonal() * numeric * scale.asDiagonal(),
                           1e-5));
    EXPECT_TRUE(
        MatrixNear(at.normal, at.normal.transpose(), 1e-9 * at.normal.diagonal().maxCoeff()));
    EXPECT_LT(at.squared_norm, 1e-15);
  }
}

TEST(MarkerBatch, FindsTheTruthExactlyWithoutNoise) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : AllScenes()) {
    SCOPED_TRACE(Name(scene));
    const Drawn d = DrawScene(rng, scene, 0.0);
    const MarkerBatch batch(d.markers.data, scene.sigma);
    const Blocks truth = StartAt(d.markers.data, d.truth.mounts);
    const Blocks far = Moved(truth, 0.02 * testing::Normal(rng, MarkerLayout(d.markers.data).size));
    const Blocks found = Solved(batch, far);
    EXPECT_LT(BlockDifference(found, truth).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(MarkerBatch, AgreesWithTheProblemOfAllParameters) {
  auto rng = SeededByTest();
  for (const MarkerScene& scene : AllScenes()) {
    SCOPED_TRACE(Name(scene));
    const Drawn d = DrawScene(rng, scene, 1.0);
    const MarkerBatch batch(d.markers.data, scene.sigma);
    const Blocks start = StartAt(d.markers.data, d.truth.mounts);
    const Blocks found = Solved(batch, start);
    const NormalEquations at = Evaluate(batch, found);
    const MarkerReference reference = SolveMarkerReference(d.markers.data, scene.sigma, start);
    ASSERT_TRUE(reference.converged) << reference.message;
    const Eigen::MatrixXd covariance = at.normal.inverse();
    const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
    const Eigen::VectorXd scale = sigma.cwiseInverse();
    const Eigen::VectorXd apart = BlockDifference(found, reference.parameters).cwiseProduct(scale);
    EXPECT_LT(apart.cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT(BlockDifference(found, reference.parameters).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_NEAR(at.squared_norm / reference.squared_norm, 1.0, 1e-10);
    EXPECT_TRUE(MatrixNear(scale.asDiagonal() * covariance * scale.asDiagonal(),
                           scale.asDiagonal() * reference.covariance * scale.asDiagonal(),
                           1e-6));
  }
}

// A tracker far better than the robot, and the other way about: nothing is lost in differences.
TEST(MarkerBatch, KeepsItsDigitsWhereOneNoiseDwarfsTheOther) {
  auto rng = SeededByTest();
  for (const double robot_noise : {1e-12, 1e-2}) {
    MarkerScene scene;
    scene.sigma.setConstant(robot_noise > 1e-6 ? 1e-10 : 1e-4);
    scene.robot_noise = robot_noise;
    const Drawn d = DrawScene(rng, scene, 1.0);
    const MarkerBatch batch(d.markers.data, scene.sigma);
    const Blocks found = Solved(batch, StartAt(d.markers.data, d.truth.mounts));
    const NormalEquations at = Evaluate(batch, found);
    const int freedom = d.markers.NumResiduals() - d.markers.NumParameters();
    EXPECT_GT(at.squared_norm, 0.5 * freedom);
    EXPECT_LT(at.squared_norm, 1.5 * freedom);
    const Eigen::VectorXd step = at.normal.ldlt().solve(at.gradient);
    EXPECT_LT(step.dot(at.gradient), 1e-12);  // squared sigmas
  }
}

// Degrees of freedom that the robot's draws take, and the covariance of a measured tool pose,
// against the plain problem written out: all rows, all parameters, no elimination.
struct Plain {
  Eigen::MatrixXd rows;  // whitened readings, then draws; by globals, trackers, draws
  int globals = 0, draws = 0;
};

Plain WriteOut(const MarkerData& data, const Eigen::Vector3d& sigma, const BaseAndTool& mounts) {
  const int poses = static_cast<int>(data.poses.size());
  Plain plain;
  plain.globals = 12;
  plain.draws = 6 * poses;
  const int size = 12 + 12 * poses, readings = 3 * static_cast<int>(data.readings.size());
  const auto residuals = [&](const Eigen::VectorXd& y) {
    Eigen::VectorXd r(readings + 6 * poses);
    const Pose3d base = Plus(mounts.world_from_base, Vector6d(y.head<6>()));
    const Pose3d tool = Plus(mounts.platform_from_tool, Vector6d(y.segment<6>(6)));
    for (int i = 0; i < poses; ++i) {
      const MarkerPose& pose = data.poses[i];
      const Vector6d draw = y.segment<6>(12 + 6 * poses + 6 * i);
      const Pose3d tracker = Plus(pose.tracker_from_world, Vector6d(y.segment<6>(12 + 6 * i)));
      const Pose3d platform = Plus(pose.base_from_platform, Vector6d(pose.robot_root * draw));
      for (int k = pose.first_base; k < pose.end; ++k) {
        const bool is_tool = k >= pose.first_tool;
        const MarkerMean& reading = data.readings[k];
        const Eigen::Vector3d p = data.bodies[is_tool ? 1 : 0].p_in_body.col(reading.marker);
        const Eigen::Vector3d seen = is_tool ? tracker * base * platform * tool * p : tracker * p;
        r.segment<3>(3 * k) =
            std::sqrt(reading.frames) * (reading.p_in_tracker - seen).cwiseQuotient(sigma);
      }
      r.segment<6>(readings + 6 * i) = draw;
    }
    return r;
  };
  plain.rows = testing::NumericJacobian(residuals, size);
  return plain;
}

TEST(MarkerBatch, CountsTheFreedomOfTheRobotsDraws) {
  auto rng = SeededByTest();
  for (const double robot_noise : {1e-5, 1e-4, 1e-3}) {
    MarkerScene scene;
    scene.robot_noise = robot_noise;
    const Drawn d = DrawScene(rng, scene, 0.0);
    const MarkerData& data = d.markers.data;
    const MarkerBatch batch(data, scene.sigma);
    const Blocks blocks = StartAt(data, d.truth.mounts);
    const NormalEquations at = Evaluate(batch, blocks);
    const MarkerFit fit = FitOf(batch, blocks, at);

    const Plain plain = WriteOut(data, scene.sigma, d.truth.mounts);
    const Eigen::MatrixXd all = (plain.rows.transpose() * plain.rows).inverse();
    const Eigen::MatrixXd expected = all.topLeftCorner(12, 12);
    const Eigen::VectorXd scale = expected.diagonal().cwiseSqrt().cwiseInverse();
    EXPECT_TRUE(MatrixNear(scale.asDiagonal() * at.normal.inverse() * scale.asDiagonal(),
                           scale.asDiagonal() * expected * scale.asDiagonal(),
                           1e-5));
    // Each draw has a prior of one row; what is left of its variance is what it does not take.
    const double free = all.bottomRightCorner(plain.draws, plain.draws).trace();
    EXPECT_NEAR(fit.draw_freedom, plain.draws - free, 1e-5 * plain.draws);
    EXPECT_GT(fit.draw_freedom, 0.01);
    EXPECT_LT(fit.draw_freedom, plain.draws);
  }
}

TEST(MarkerBatch, DoesNotDependOnThreads) {
  auto rng = SeededByTest();
  MarkerScene scene;
  scene.poses = 700;
  scene.frames = 1;
  scene.robot_noise = 1e-4;
  const Drawn d = DrawScene(rng, scene, 1.0);
  const Blocks point = StartAt(d.markers.data, d.truth.mounts);
  const NormalEquations one = Evaluate(MarkerBatch(d.markers.data, scene.sigma, 1), point);
  for (const int threads : {2, 3, 16}) {
    const NormalEquations many = Evaluate(MarkerBatch(d.markers.data, scene.sigma, threads), point);
    EXPECT_TRUE(testing::SameBits(many.normal, one.normal));
    EXPECT_TRUE(testing::SameBits(many.gradient, one.gradient));
    EXPECT_TRUE(testing::SameBits(many.squared_norm, one.squared_norm));
  }
}

TEST(MarkerShape, OfACentroidBodyHasItsFrame) {
  auto rng = SeededByTest();
  for (const auto& axis : {std::array<int, 2>{0, 1}, {1, 0}, {0, 2}, {2, 0}, {1, 2}, {2, 1}}) {
    MarkerShape shape;
    shape.is_centroid = true;
    shape.x_axis = axis;
    const Eigen::Vector3d parameters(0.1, testing::Uniform(rng, -0.1, 0.1), 0.07);
    shape.p_in_body = shape.FromParameters(parameters);
    EXPECT_LT(shape.p_in_body.rowwise().sum().norm(), 1e-16);
    EXPECT_TRUE(MatrixNear(shape.p_in_body.col(axis[1]) - shape.p_in_body.col(axis[0]),
                           Eigen::Vector3d(0.1, 0, 0),
                           1e-16));
    EXPECT_TRUE(MatrixNear(shape.Parameters(), parameters, 1e-16));
  }
}

}  // namespace
}  // namespace hexcal
