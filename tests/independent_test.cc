// SPDX-License-Identifier: BSD-3-Clause
// A dataset, its truth and the figures of a fit, all from a program that shares no code with hexcal
// (tests/data/independent).
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "config/table.h"
#include "estimator/calibrate.h"
#include "measurement/dataset.h"
#include "model/predict.h"

namespace hexcal {
namespace {

const std::string kFolder = HEXCAL_INDEPENDENT_DATA;

// RMS distance between predicted and true tool positions, m.
double Gap(const Dataset& heldout, const Machine& machine) {
  const std::vector<Pose3d> predicted = PredictToolPoses(machine, ReportedPoses(heldout));
  TableReader truth = TableReader::FromFile(kFolder + "/heldout/truth.csv");
  double sum = 0.0;
  int count = 0;
  while (truth.Next()) {
    std::size_t row = 0;
    while (heldout.robot_poses.rows.at(row).label != truth.Text(0)) ++row;
    const Eigen::Vector3d p_in_world(truth.Number(1), truth.Number(2), truth.Number(3));
    sum += (predicted[row].translation - p_in_world).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Independent, ChiSquareAndHeldOutGapAreThoseOfTheOtherProgram) {
  const Dataset dataset = ReadDataset(kFolder + "/dataset.yaml", true);
  const Estimate estimate = Calibrate(MakeObservations(dataset), {}, {});
  ASSERT_TRUE(estimate.IsTrustworthy());
  EXPECT_EQ(estimate.degrees_of_freedom, 420);
  EXPECT_NEAR(estimate.chi_square, 411.50, 0.01);
  Machine machine;
  machine.world_from_base = estimate.mounts.world_from_base;
  machine.platform_from_tool = estimate.mounts.platform_from_tool;
  EXPECT_NEAR(
      Gap(ReadDataset(kFolder + "/heldout/dataset.yaml", false), machine), 2.304e-5, 0.002e-5);
}

}  // namespace
}  // namespace hexcal
