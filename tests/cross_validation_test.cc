// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/cross_validation.h"

#include <algorithm>

#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::HexapodObservations;
using testing::SeededByTest;
using testing::UnknownNoise;

TEST(CrossValidation, FoldsAreOfEqualSizeButForOne) {
  for (const std::size_t poses : {10, 11, 60, 997}) {
    const std::vector<int> folds = DrawFolds(poses, 5, 7);
    ASSERT_EQ(folds.size(), poses);
    for (int fold = 0; fold < 5; ++fold) {
      const auto size = static_cast<std::size_t>(std::count(folds.begin(), folds.end(), fold));
      EXPECT_GE(size, poses / 5);
      EXPECT_LE(size, poses / 5 + 1);
    }
  }
}

TEST(CrossValidation, FoldsFollowTheSeed) {
  EXPECT_EQ(DrawFolds(60, 5, 1), DrawFolds(60, 5, 1));
  EXPECT_NE(DrawFolds(60, 5, 1), DrawFolds(60, 5, 2));
}

TEST(CrossValidation, LeavesOneOutOfFewPosesAndNoneOfTooFew) {
  std::vector<int> folds = DrawFolds(4, 5, 1);
  std::sort(folds.begin(), folds.end());
  EXPECT_EQ(folds, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(DrawFolds(3, 5, 1).empty());
  EXPECT_TRUE(DrawFolds(5, 2, 1).empty());  // a fold of three leaves two
}

// A fit that is off by a known amount, and that must not have seen what it predicts.
TEST(CrossValidation, JudgesEveryPoseByTheOthers) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const Observations observations = UnknownNoise(HexapodObservations(rng, truth, 11));
  const std::vector<int> folds = DrawFolds(11, 5, 3);
  int fits = 0;
  std::vector<int> seen(11, 0);
  const HeldOutError error = CrossValidate(observations, folds, [&](const Observations& kept) {
    for (const Observation& o : kept.items) ++seen[std::stoi(o.label) - 1];
    Vector6d off;
    off << 0.003, -0.004, 0.0, 0.0, 0.0, 0.0;
    MethodFit fit;
    fit.mounts = {Plus(truth.world_from_base, off), truth.platform_from_tool};
    fit.converged = ++fits != 2;
    return fit;
  });
  EXPECT_EQ(fits, 5);
  EXPECT_EQ(seen, std::vector<int>(11, 4));  // by all fits but its own
  EXPECT_NEAR(error.position, 0.005, 1e-12);
  EXPECT_NEAR(error.orientation, 0.0, 1e-12);
  EXPECT_EQ(error.not_converged, 1);
}

}  // namespace
}  // namespace hexcal
