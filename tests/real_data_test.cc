// SPDX-License-Identifier: BSD-3-Clause
// Real measurements that may not be copied: their folder is given by the environment variable
// HEXCAL_DATA; without it these tests are skipped. Expected values come from independent solutions
// of others (README.md of that folder).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include "discovery/discover.h"
#include "estimator/calibrate.h"
#include "estimator/outliers.h"
#include "measurement/dataset.h"

namespace hexcal {
namespace {

class RealData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("HEXCAL_DATA") == nullptr) GTEST_SKIP() << "HEXCAL_DATA is not set";
  }

  static Dataset Read(const std::string& name) {
    const std::string folder = std::getenv("HEXCAL_DATA");
    return ReadDataset(folder + "/" + name + "/dataset.yaml", true);
  }

  static Estimate Fit(const std::string& name, const CalibrateOptions& options = {}) {
    return Calibrate(MakeObservations(Read(name)), {}, options);
  }

  static DiscoverOptions ThreeFolds() {
    DiscoverOptions options;
    options.bootstraps = 199;
    options.folds = 3;
    return options;
  }
};

TEST_F(RealData, Em1500WithEqualWeightsIsTheIndependentSolution) {
  CalibrateOptions options;
  options.noise = NoiseLevels{1e-3, 1e-3};
  const Estimate estimate = Fit("em1500", options);
  ASSERT_TRUE(estimate.IsTrustworthy());
  const Eigen::Vector3d base(-1.5644151, 2.91886951, -1.3202489),
      tool(-0.55539083, -0.67546614, -0.32764947);
  EXPECT_LT((estimate.mounts.world_from_base.translation - base).norm(), 5e-5);
  EXPECT_LT((estimate.mounts.platform_from_tool.translation - tool).norm(), 5e-5);
  EXPECT_NEAR(estimate.rmspe, 0.500e-3, 0.0006e-3);
  EXPECT_NEAR(estimate.rmsoe, 0.468e-3, 0.0006e-3);
}

TEST_F(RealData, Jugglebot60FromItsLegLengths) {
  const Estimate estimate = Fit("jugglebot60");
  ASSERT_TRUE(estimate.IsTrustworthy());
  EXPECT_NEAR(estimate.rmspe, 1.00e-3, 0.006e-3);
  EXPECT_NEAR(estimate.rmsoe, 3.45e-3, 0.006e-3);
}

TEST_F(RealData, TabbDataset1WithEstimatedWeights) {
  const Estimate estimate = Fit("tabb-dataset-1");
  ASSERT_TRUE(estimate.IsTrustworthy());
  EXPECT_TRUE(estimate.noise.estimated);
  EXPECT_NEAR(estimate.rmspe, 4.17e-3, 0.01e-3);
  EXPECT_NEAR(estimate.rmsoe, 7.23e-3, 0.01e-3);
}

TEST_F(RealData, ScaraOneAxisLosesTheShiftAlongItsAxis) {
  const Estimate estimate = Fit("scara-one-axis");
  EXPECT_TRUE(estimate.converged);
  EXPECT_FALSE(estimate.IsTrustworthy());
  ASSERT_EQ(estimate.observability.weak_directions.size(), 1u);
  EXPECT_NE(estimate.observability.weak_directions[0].find("base.dz"), std::string::npos);
  EXPECT_FALSE(estimate.observability.determined[2]);
}

// Corner order flips of a checkerboard. Plain least squares leaves 5.7 mm RMS with a median of 3.4.
TEST_F(RealData, Ur3TwoCamerasHasTwoOutliers) {
  const std::string folder = std::getenv("HEXCAL_DATA");
  const Observations all =
      MakeObservations(ReadDataset(folder + "/ur3-two-cameras/dataset.yaml", true));
  for (const double alpha : {0.001, 0.01, 0.05}) {
    const std::vector<Outlier> outliers = FindOutliers(all, {}, {alpha}).outliers;
    ASSERT_EQ(outliers.size(), 2u);
    EXPECT_EQ(outliers[0].label, "24");
    EXPECT_EQ(outliers[1].label, "25");
    const Estimate estimate = Calibrate(Without(all, outliers), {}, {});
    ASSERT_TRUE(estimate.IsTrustworthy());
    std::vector<double> errors;
    for (const PoseResult& pose : estimate.poses) errors.push_back(pose.residual.head<3>().norm());
    std::nth_element(errors.begin(), errors.begin() + 19, errors.end());
    EXPECT_LE(errors[19], 3.1e-3);  // the upper of the two middle ones of 38
  }
}

// Chi-square of 77 poses at 40 um and 0.16 mrad.
double AtStatedLevels(const GapSize& size) {
  const double position = size.rms_position / 40e-6, orientation = size.rms_orientation / 0.16e-3;
  return 77.0 * (position * position + orientation * orientation);
}

// Base and tool alone leave 0.50 mm on poses held out by threes. No leg geometry is published: a
// map of the pose describes the gap, errors of a hexapod explain nearly all of it.
TEST_F(RealData, Em1500sGapIsDescribedOverThePose) {
  const Discovery discovery = Discover(Read("em1500"), ThreeFolds());
  EXPECT_GT(discovery.gap.heldout_before.rms_position, 0.45e-3);
  EXPECT_LT(discovery.gap.heldout_after.rms_position, 0.12e-3);
  EXPECT_NEAR(AtStatedLevels(discovery.gap.before), 12400, 300);

  ASSERT_TRUE(discovery.leg_geometry.has_value());
  const GeometryClass& geometry = *discovery.leg_geometry;
  EXPECT_LT(AtStatedLevels(geometry.after), 420.0);
  EXPECT_LT(geometry.heldout.rms_position, 0.2e-3);
  // The smaller held-out chi-square is in the model, and the other one is not forgotten.
  if (geometry.is_in_model) {
    EXPECT_LT(geometry.heldout.chi_square, geometry.heldout_map.chi_square);
  }
  ASSERT_EQ(discovery.effects.size(), 1u);
  std::set<std::string> members = {discovery.effects[0].effect.name};
  for (const Rival& rival : discovery.effects[0].could_also_be) members.insert(rival.name);
  for (const char* name : {"base_joint_offset", "platform_joint_offset", "leg_offset", "unknown"})
    EXPECT_EQ(members.count(name), 1u) << name;
  EXPECT_EQ(discovery.verdict,
            geometry.is_in_model && geometry.is_complete ? Verdict::kExplained
                                                         : Verdict::kPartlyExplained);
}

TEST_F(RealData, Jugglebot60sLegsAndJointsAreNamed) {
  const Discovery discovery = Discover(Read("jugglebot60"), ThreeFolds());
  std::set<std::string> sites;
  for (const DiscoveredEffect& found : discovery.effects) sites.insert(found.site);
  EXPECT_EQ(sites.count("leg") + sites.count("base_joint") + sites.count("platform_joint"), 3u);
  EXPECT_GT(discovery.gap.heldout_before.rms_position, 0.95e-3);
  EXPECT_LT(discovery.gap.heldout_after.rms_position, 0.60e-3);
}

}  // namespace
}  // namespace hexcal
