// SPDX-License-Identifier: BSD-3-Clause
#include "model/leg_error.h"

#include <gtest/gtest.h>

#include "model/hexapod.h"
#include "testing/hexapods.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

// A leg is longer than it reports: the tool, as measured against as predicted, says so of that leg
// alone.
TEST(LegsByError, NamesTheLegThatIsLonger) {
  auto rng = testing::SeededByTest();
  const HexapodGeometry hexapod = testing::LargeHexapod();
  const Pose3d platform_from_tool = testing::RandomPose(rng, 0.3);
  constexpr double kLonger = 1e-5;
  for (int leg = 0; leg < kNumLegs; ++leg) {
    Pose3d reported = testing::SmallPose(rng, 0.04, 0.2);
    reported.translation.z() += testing::kLargeHeight;
    LegLengths lengths = InverseKinematics(hexapod, reported);
    lengths[leg] += kLonger;
    const auto moved = ForwardKinematics(hexapod, lengths, reported);
    ASSERT_TRUE(moved.converged);
    const Vector6d error =
        Minus(moved.base_from_platform * platform_from_tool, reported * platform_from_tool);
    const LegLengths found = LegsByError(hexapod, reported, platform_from_tool) * error;
    EXPECT_TRUE(
        testing::MatrixNear(found, LegLengths(kLonger * LegLengths::Unit(leg)), 1e-3 * kLonger));
  }
}

}  // namespace
}  // namespace hexcal
