// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_stream.h"

#include <gtest/gtest.h>

#include "estimator/observations.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

// Any covariance with coordinates of about a millimetre and a milliradian, none of them alike.
template <typename Rng>
Matrix6d AnyCovariance(Rng& rng) {
  Matrix6d a;
  for (int i = 0; i < 36; ++i) a(i) = 1e-3 * testing::Uniform(rng, -1, 1);
  return a * a.transpose() + 1e-7 * Matrix6d::Identity();
}

struct Scene {
  std::vector<Observation> rows;
  BaseAndTool mounts;
  PoseBatch batch;
};

// Measured poses off by `shift` m and `turn` rad each axis from what mounts predict.
template <typename Rng>
Scene MakeScene(Rng& rng, int poses, double shift, double turn) {
  Scene scene;
  scene.mounts = testing::AnyMounts(rng);
  scene.rows = testing::HexapodObservations(rng, scene.mounts, poses);
  for (Observation& o : scene.rows) {
    o.world_from_tool = o.world_from_tool * testing::SmallPose(rng, shift, turn);
    scene.batch.Add(o.base_from_platform, o.world_from_tool);
  }
  return scene;
}

// The same sums, pose by pose from PoseError and its Jacobian.
NormalEquations Expected(const Scene& scene,
                         const std::vector<Matrix6d>& covariances,
                         const RobustLoss& loss) {
  NormalEquations sum{Matrix12d::Zero(), Vector12d::Zero(), 0.0, 0.0, 0.0, 0};
  for (std::size_t i = 0; i < scene.rows.size(); ++i) {
    const LinearisedError e = Linearise(scene.rows[i], scene.mounts);
    const Matrix6d w = WhitenerOf(covariances[i]);
    const Vector6d r = w * e.error;
    const Matrix6x12d j = w * e.jacobian;
    double rho = 0.0, weight = 0.0;
    loss.Evaluate(r.squaredNorm(), &rho, &weight);
    sum.normal += weight * j.transpose() * j;
    sum.gradient += weight * j.transpose() * r;
    sum.squared_norm += rho;
    sum.position_squares += e.error.head<3>().squaredNorm();
    sum.orientation_squares += e.error.tail<3>().squaredNorm();
    ++sum.poses;
  }
  return sum;
}

void ExpectSame(const NormalEquations& actual, const NormalEquations& expected) {
  // In units of each parameter's own column.
  const Eigen::VectorXd scale = expected.normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd normal = scale.asDiagonal() * actual.normal * scale.asDiagonal();
  const Eigen::MatrixXd wanted = scale.asDiagonal() * expected.normal * scale.asDiagonal();
  EXPECT_TRUE(testing::MatrixNear(normal, wanted, 1e-12));
  EXPECT_TRUE(testing::MatrixNear(scale.cwiseProduct(actual.gradient),
                                  scale.cwiseProduct(expected.gradient),
                                  1e-12 * std::sqrt(expected.squared_norm) + 1e-11));
  const auto near = [](double a, double b) {
    return std::abs(a - b) <= 1e-12 * std::abs(b) + 1e-20;
  };
  EXPECT_TRUE(near(actual.squared_norm, expected.squared_norm));
  EXPECT_TRUE(near(actual.position_squares, expected.position_squares));
  EXPECT_TRUE(near(actual.orientation_squares, expected.orientation_squares));
  EXPECT_EQ(actual.poses, expected.poses);
}

// Errors from rounding to half a turn, numbers of poses that fill blocks and that do not, more than
// one chunk.
struct Case {
  int poses;
  double shift, turn;
};

class PoseStreamTest : public ::testing::TestWithParam<Case> {};

TEST_P(PoseStreamTest, IsotropicSumsAreThoseOfTheRows) {
  auto rng = SeededByTest();
  const Case c = GetParam();
  const Scene scene = MakeScene(rng, c.poses, c.shift, c.turn);
  // Near enough to the errors' size that no loss gives all of them the weight zero.
  const double p = 2e-4 + 0.5 * c.shift, o = 7e-4 + 0.5 * c.turn;
  Vector6d variances;
  variances << p * p, p * p, p * p, o * o, o * o, o * o;
  const std::vector<Matrix6d> covariances(scene.rows.size(), variances.asDiagonal());
  for (const LossKind kind :
       {LossKind::kNone, LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    const RobustLoss loss = DefaultLoss(kind);
    const PoseWeights weights = PoseWeights::Isotropic(p, o);
    const NormalEquations sums = PoseStream(scene.batch, weights, loss).At(scene.mounts);
    ExpectSame(sums, Expected(scene, covariances, loss));
  }
}

TEST_P(PoseStreamTest, CommonWeightsAreThoseOfTheRows) {
  auto rng = SeededByTest();
  const Case c = GetParam();
  const Scene scene = MakeScene(rng, c.poses, c.shift, c.turn);
  const Matrix6d covariance = AnyCovariance(rng);
  const std::vector<Matrix6d> covariances(scene.rows.size(), covariance);
  for (const LossKind kind : {LossKind::kNone, LossKind::kCauchy}) {
    const RobustLoss loss = DefaultLoss(kind);
    const PoseWeights weights = PoseWeights::Common(covariance);
    const NormalEquations sums = PoseStream(scene.batch, weights, loss).At(scene.mounts);
    ExpectSame(sums, Expected(scene, covariances, loss));
  }
}

TEST_P(PoseStreamTest, WeightsOfEachPoseAreThoseOfTheRows) {
  auto rng = SeededByTest();
  const Case c = GetParam();
  const Scene scene = MakeScene(rng, c.poses, c.shift, c.turn);
  std::vector<Matrix6d> covariances;
  PoseWeights weights = PoseWeights::PerPose(scene.rows.size());
  for (std::size_t i = 0; i < scene.rows.size(); ++i) {
    covariances.push_back(AnyCovariance(rng));
    weights.Add(covariances.back());
  }
  for (const LossKind kind : {LossKind::kNone, LossKind::kHuber}) {
    const RobustLoss loss = DefaultLoss(kind);
    const NormalEquations sums = PoseStream(scene.batch, weights, loss).At(scene.mounts);
    ExpectSame(sums, Expected(scene, covariances, loss));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         PoseStreamTest,
                         ::testing::Values(Case{4, 0.0, 0.0},
                                           Case{3, 1e-3, 1e-3},
                                           Case{60, 1e-3, 1e-3},
                                           Case{61, 0.1, 0.25},
                                           Case{62, 1.0, 0.6},
                                           Case{63, 1.0, 1.8},
                                           Case{2500, 1e-3, 0.3}));

TEST(PoseStream, PartsAddUpAtAnyWeights) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng, 17, 1e-3, 1e-2);
  const PoseWeights unit = PoseWeights::Isotropic(1.0, 1.0),
                    other = PoseWeights::Isotropic(2.0, 5.0);
  const IsotropicSums parts = PoseStream(scene.batch, unit).PartsAt(scene.mounts);
  const NormalEquations sums = PoseStream(scene.batch, other).At(scene.mounts);
  const NormalEquations weighted = Weighted(parts, 0.25, 0.04, 17);
  EXPECT_TRUE(testing::MatrixNear(weighted.normal, sums.normal, 1e-13));
  EXPECT_TRUE(testing::MatrixNear(weighted.gradient, sums.gradient, 1e-13));
  EXPECT_NEAR(0.25 * parts.position.squares + 0.04 * parts.orientation.squares,
              sums.squared_norm,
              1e-13 * sums.squared_norm);
}

// Every bit, whatever the number of threads.
TEST(PoseStream, ThreadsDoNotChangeTheSums) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng, 40001, 1e-3, 1e-2);
  const PoseWeights weights = PoseWeights::Isotropic(1e-3, 1e-3);
  const NormalEquations one = PoseStream(scene.batch, weights, {}, 1).At(scene.mounts);
  for (const int threads : {2, 3, 16}) {
    const NormalEquations many = PoseStream(scene.batch, weights, {}, threads).At(scene.mounts);
    EXPECT_TRUE(one.normal == many.normal);
    EXPECT_TRUE(one.gradient == many.gradient);
    EXPECT_EQ(one.squared_norm, many.squared_norm);
  }
}

}  // namespace
}  // namespace hexcal
