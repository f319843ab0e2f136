// SPDX-License-Identifier: BSD-3-Clause
#include "report/workspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/rotation_angles.h"
#include "model/hexapod.h"
#include "testing/hexapods.h"

namespace hexcal {
namespace {

// About a pose at this height: half widths of width times 20 mm and 0.1 rad.
Workspace Around(double height, double width) {
  Workspace workspace;
  for (int i = 0; i < 6; ++i) {
    const double middle = i == 2 ? height : 0.0, half = width * (i < 3 ? 0.02 : 0.1);
    workspace.box[i] = {middle - half, middle + half};
  }
  return workspace;
}

Dataset Limited() {
  Dataset dataset;
  dataset.hexapod = testing::LargeHexapod();
  const LegLengths home = InverseKinematics(
      *dataset.hexapod, {{0, 0, testing::kLargeHeight}, Eigen::Quaterniond::Identity()});
  dataset.hexapod->leg_limits = Eigen::Vector2d(home.minCoeff() - 0.08, home.maxCoeff() + 0.08);
  return dataset;
}

TEST(Workspace, GridIsOfEndsAndMiddlesWhereTheLegsReach) {
  const Workspace workspace = Around(testing::kLargeHeight, 1.0);
  const std::vector<Place> places = GridOf(workspace, Limited());
  ASSERT_EQ(places.size(), 729u);
  for (const Place& place : places) {
    const Vector6d y = VectorFromPose(place.base_from_platform);
    for (int i = 0; i < 6; ++i) {
      const auto& [low, high] = workspace.box[i];
      const double level = (y[i] - low) / (high - low);
      EXPECT_NEAR(level, 0.5 * std::round(2.0 * level), 1e-9);
    }
  }
}

// Beyond, a place is on the edge of the reach: 1 % further along the same way is not reached.
TEST(Workspace, GridEndsWhereTheLegsDo) {
  const Workspace workspace = Around(testing::kLargeHeight, 10.0);
  const Dataset dataset = Limited();
  const Vector6d centre = workspace.Centre();
  const std::vector<Place> places = GridOf(workspace, dataset);
  ASSERT_EQ(places.size(), 729u);
  Dataset unlimited = dataset;
  unlimited.hexapod->leg_limits.reset();
  const std::vector<Place> corners = GridOf(workspace, unlimited);
  int edges = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_TRUE(IsReached(dataset, places[k].base_from_platform));
    const Vector6d off = VectorFromPose(places[k].base_from_platform) - centre;
    const Vector6d whole = VectorFromPose(corners[k].base_from_platform) - centre;
    if (IsReached(dataset, corners[k].base_from_platform)) continue;
    ++edges;
    const double part = off.norm() / whole.norm();
    EXPECT_LT((off - part * whole).norm(), 1e-9);
    EXPECT_FALSE(IsReached(dataset, PoseFromVector(centre + (part + 0.01) * whole)));
  }
  EXPECT_GT(edges, 600);
}

TEST(Workspace, HasNoPlaceWhereItsMiddleIsBeyondReach) {
  EXPECT_TRUE(GridOf(Around(2.0, 1.0), Limited()).empty());
}

}  // namespace
}  // namespace hexcal
