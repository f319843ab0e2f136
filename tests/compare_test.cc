// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/compare.h"

#include "geometry/rotation_angles.h"
#include "testing/bits.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::HexapodObservations;
using testing::KnownNoise;
using testing::SeededByTest;
using testing::TrackerLikeCovariance;

CompareOptions Small() {
  CompareOptions options;
  options.draws = 1000;
  options.starts = 0;
  return options;
}

template <typename Rng>
Observations Noisy(Rng& rng, int poses) {
  const BaseAndTool truth{testing::SmallPose(rng, 0.1, 0.2), testing::SmallPose(rng, 0.1, 0.2)};
  auto rows = HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  return KnownNoise(rows, TrackerLikeCovariance());
}

TEST(Compare, JudgesEveryMethodAlike) {
  auto rng = SeededByTest();
  const Observations observations = Noisy(rng, 30);
  const Comparison comparison = Compare(observations, {}, Small());
  ASSERT_EQ(comparison.methods.size(), kMethods.size() - 1);  // there are no markers
  EXPECT_EQ(comparison.folds, 5);
  const Estimate& reference = comparison.reference;
  for (std::size_t k = 0; k < comparison.methods.size(); ++k) {
    const MethodResult& result = comparison.methods[k];
    // The paper's takes more than 20 steps to its last digit.
    EXPECT_EQ(result.fit.converged, result.method != Method::kPaper) << result.fit.message;
    const auto difference = Difference(result.fit.mounts, reference.mounts);
    double squares = 0.0;
    for (const Observation& o : observations.items)
      squares += PoseError(result.fit.mounts, o.base_from_platform, o.world_from_tool)
                     .head<3>()
                     .squaredNorm();
    EXPECT_NEAR(result.rmspe, std::sqrt(squares / 30), 1e-12);
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(result.sigmas[i] * std::sqrt(reference.covariance(i, i)), difference[i], 1e-12);
    ASSERT_TRUE(result.held_out);
    EXPECT_GT(result.held_out->orientation, 0.9 * result.rmsoe);
    EXPECT_LT(result.held_out->orientation, 2.0 * result.rmsoe);
    EXPECT_GT(result.seconds, 0.0);
  }
  const auto find = [&](Method method) {
    return *std::find_if(comparison.methods.begin(), comparison.methods.end(), [=](const auto& r) {
      return r.method == method;
    });
  };
  EXPECT_EQ(find(Method::kNonlinear).sigmas.norm(), 0.0);
  EXPECT_EQ(find(Method::kRobust).sigmas.norm(), 0.0);  // there are no outliers
  EXPECT_LT(find(Method::kTwist).sigmas.norm(), 0.05);  // the same weights by another way
  EXPECT_GT(find(Method::kPaper).sigmas.norm(), 1e-2);
  EXPECT_TRUE(find(Method::kShah).fit.iterations.empty());
  EXPECT_GE(find(Method::kPaper).fit.iterations.size(), 3u);
  EXPECT_TRUE(comparison.certificate.certified) << comparison.certificate.why;
  EXPECT_TRUE(comparison.propagation.done);
  EXPECT_TRUE(comparison.paper_map.share.empty());
}

TEST(Compare, SaysWhatTheDataDoNotTell) {
  auto rng = SeededByTest();
  Observations observations = Noisy(rng, 3);
  const Comparison few = Compare(observations, {}, Small());
  EXPECT_EQ(few.folds, 0);
  EXPECT_FALSE(few.methods[0].held_out);

  const BaseAndTool truth{testing::SmallPose(rng, 0.1, 0.2), testing::SmallPose(rng, 0.1, 0.2)};
  auto rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) {
    o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -1, 1)));
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Comparison one_axis = Compare(KnownNoise(rows, TrackerLikeCovariance()), {}, Small());
  EXPECT_FALSE(one_axis.reference.IsTrustworthy());
  EXPECT_FALSE(one_axis.certificate.certified);
  EXPECT_FALSE(one_axis.propagation.done);
  EXPECT_TRUE(std::isnan(one_axis.methods[3].sigmas[2]));  // base.dz against tool
  EXPECT_TRUE(std::isfinite(one_axis.methods[3].sigmas[3]));
}

TEST(Compare, OnlyTheRobustSolutionStaysWithAnOutlier) {
  auto rng = SeededByTest();
  Observations observations = Noisy(rng, 30);
  const Estimate clean = Calibrate(observations, {}, {});
  observations.items[7].world_from_tool.translation.x() += 0.02;
  const Comparison comparison = Compare(observations, {}, Small());
  for (const MethodResult& result : comparison.methods) {
    const auto d = Difference(result.fit.mounts, clean.mounts);
    double most = 0.0;
    for (int i = 0; i < 12; ++i)
      most = std::max(most, std::abs(d[i]) / std::sqrt(clean.covariance(i, i)));
    if (result.method == Method::kRobust)
      EXPECT_LT(most, 1.5);
    else
      EXPECT_GT(most, 2.0) << InfoOf(result.method).name;
  }
}

CompareOptions Mapping(int starts, int threads = 1) {
  CompareOptions options = Small();
  options.starts = starts;
  options.threads = threads;
  return options;
}

TEST(ConvergenceMap, TheTwistArrivesFromFartherThanThePaper) {
  auto rng = SeededByTest();
  const Observations observations = Noisy(rng, 20);
  const Comparison one = Compare(observations, {}, Mapping(6));
  const Comparison three = Compare(observations, {}, Mapping(6, 3));
  EXPECT_EQ(one.paper_map.share, three.paper_map.share);
  EXPECT_EQ(one.twist_map.share, three.twist_map.share);
  EXPECT_TRUE(one.paper_map.has_limit && one.twist_map.has_limit);
  EXPECT_EQ(one.paper_map.rotation_errors.front(), 0.0);
  EXPECT_EQ(one.paper_map.share.front().front(), 1.0);
  EXPECT_EQ(one.twist_map.share.front().front(), 1.0);
  double paper = 0.0, twist = 0.0;
  for (std::size_t i = 0; i < one.twist_map.share.size(); ++i)
    for (std::size_t j = 0; j < one.twist_map.share[i].size(); ++j) {
      paper += one.paper_map.share[i][j];
      twist += one.twist_map.share[i][j];
    }
  EXPECT_GT(twist, paper);
  EXPECT_GT(paper, 0.0);
}

TEST(ConvergenceMap, AfterOneIterationOnlyGoodStartsHaveArrived) {
  auto rng = SeededByTest();
  CompareOptions options = Mapping(4);
  options.calibrate.linearized.max_iterations = 1;
  const Comparison comparison = Compare(Noisy(rng, 20), {}, options);
  EXPECT_EQ(comparison.twist_map.share[0][0], 1.0);
  EXPECT_EQ(comparison.twist_map.share[6][0], 0.0);  // 60 degrees
}

// With the world turned about its x axis by a third of a turn, differences of pose vectors no
// longer are what J takes them for.
TEST(ConvergenceMap, SaysWhereThePaperStandsNowhere) {
  auto rng = SeededByTest();
  Observations observations = Noisy(rng, 20);
  const Pose3d turned{Eigen::Vector3d::Zero(), Exp(Eigen::Vector3d(2.0, 0, 0))};
  for (Observation& o : observations.items) o.world_from_tool = turned * o.world_from_tool;
  const Comparison comparison = Compare(observations, {}, Mapping(2));
  EXPECT_FALSE(comparison.paper_map.has_limit);
  EXPECT_EQ(comparison.paper_map.share[0][0], 0.0);
  EXPECT_TRUE(comparison.twist_map.has_limit);
  EXPECT_EQ(comparison.twist_map.share[0][0], 1.0);
}

}  // namespace
}  // namespace hexcal
