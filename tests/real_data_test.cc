// SPDX-License-Identifier: BSD-3-Clause
// Real measurements that may not be copied: their folder is given by the environment variable
// HEXCAL_DATA; without it these tests are skipped. Expected values come from independent solutions
// of others (README.md of that folder).
#include <gtest/gtest.h>

#include <cstdlib>

#include "estimator/calibrate.h"
#include "measurement/dataset.h"

namespace hexcal {
namespace {

class RealData : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("HEXCAL_DATA") == nullptr) GTEST_SKIP() << "HEXCAL_DATA is not set";
  }

  static Estimate Fit(const std::string& name, const CalibrateOptions& options = {}) {
    const std::string folder = std::getenv("HEXCAL_DATA");
    return Calibrate(
        MakeObservations(ReadDataset(folder + "/" + name + "/dataset.yaml", true)), {}, options);
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

}  // namespace
}  // namespace hexcal
