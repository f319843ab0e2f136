// SPDX-License-Identifier: BSD-3-Clause
#include "apps/calibrate_options.h"

#include <gflags/gflags.h>
#include <gtest/gtest.h>

#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/usage_error.h"

namespace hexcal {
namespace {

class CalibrateOptionsTest : public ::testing::Test {
 private:
  gflags::FlagSaver saver_;  // puts the flags back after each test
};

void Set(const char* name, const char* value) {
  ASSERT_EQ(SetFlag(*FindFlag(name), value), std::nullopt) << name;
}

TEST_F(CalibrateOptionsTest, WithoutFlagsTheNonlinearSolverEstimatesTheNoise) {
  const CalibrateOptions options = CalibrateOptionsFromFlags();
  EXPECT_EQ(options.solver, Solver::kNonlinear);
  EXPECT_FALSE(options.start.has_value());
  EXPECT_FALSE(options.noise.has_value());
  EXPECT_EQ(options.outliers, OutlierHandling::kKeep);
  EXPECT_EQ(HeaderOf("d", options, false).error, "");
}

TEST_F(CalibrateOptionsTest, EveryFlagReachesItsOption) {
  Set("solver", "linearized");
  Set("error", "twist");
  Set("unit_magnitude", "nearest_rotation");
  Set("iterations", "7");
  Set("tolerance", "1e-5");
  Set("start", "park_martin");
  Set("noise_position", "0.25");
  Set("noise_orientation", "0.5");
  Set("outliers", "reject");
  const CalibrateOptions options = CalibrateOptionsFromFlags();
  EXPECT_EQ(options.solver, Solver::kLinearized);
  EXPECT_EQ(options.linearized.error, LinearizedOptions::Error::kTwist);
  EXPECT_EQ(options.linearized.unit_magnitude, LinearizedOptions::UnitMagnitude::kNearestRotation);
  EXPECT_EQ(options.linearized.max_iterations, 7);
  EXPECT_EQ(options.linearized.tolerance, 1e-5);
  EXPECT_EQ(options.start, Start::kParkMartin);
  ASSERT_TRUE(options.noise.has_value());
  EXPECT_EQ(options.noise->position, 0.25);
  EXPECT_EQ(options.noise->orientation, 0.5);
  EXPECT_EQ(options.outliers, OutlierHandling::kReject);
  const ResultHeader header = HeaderOf("d", options, false);
  EXPECT_EQ(header.dataset, "d");
  EXPECT_EQ(header.solver, "linearized");
  EXPECT_EQ(header.error, "twist");
}

TEST_F(CalibrateOptionsTest, TheLossHasItsOwnScaleUnlessOneIsGiven) {
  EXPECT_EQ(CalibrateOptionsFromFlags().loss.kind, LossKind::kNone);
  Set("loss", "tukey");
  Set("covariance", "sandwich");
  EXPECT_EQ(CalibrateOptionsFromFlags().loss.kind, LossKind::kTukey);
  EXPECT_EQ(CalibrateOptionsFromFlags().loss.scale, DefaultLoss(LossKind::kTukey).scale);
  EXPECT_EQ(CalibrateOptionsFromFlags().covariance, CovarianceKind::kSandwich);
  Set("loss_scale", "3.5");
  EXPECT_EQ(CalibrateOptionsFromFlags().loss.scale, 3.5);
}

TEST_F(CalibrateOptionsTest, EveryChoiceOfAFlagHasAValue) {
  for (const char* name : {"start", "unit_magnitude", "error", "loss", "covariance"})
    for (const std::string_view choice : FindFlag(name)->choices) {
      const gflags::FlagSaver saver;
      Set(name, std::string(choice).c_str());
      CalibrateOptionsFromFlags();  // CHECKs
    }
  Set("solver", "linearized");
  EXPECT_EQ(CalibrateOptionsFromFlags().linearized.error, LinearizedOptions::Error::kPaper);
}

// Readings of markers are used as such unless something else is asked for.
TEST_F(CalibrateOptionsTest, TheResidualFollowsFromTheMeasurementTheSolverAndTheNoise) {
  Dataset markers, poses;
  markers.measurement.emplace().kind = Measurement::Kind::kMarkers;
  poses.measurement.emplace();
  const auto is_by_markers = [](const Dataset& dataset) {
    return IsByMarkers(dataset, CalibrateOptionsFromFlags());
  };
  EXPECT_TRUE(is_by_markers(markers));
  EXPECT_FALSE(is_by_markers(poses));
  Set("residual", "pose");
  EXPECT_FALSE(is_by_markers(markers));
  Set("residual", "marker");
  EXPECT_TRUE(is_by_markers(markers));
  EXPECT_THROW(is_by_markers(poses), UsageError);
  Set("solver", "linearized");
  EXPECT_THROW(is_by_markers(markers), UsageError);
  FLAGS_residual.clear();
  EXPECT_FALSE(is_by_markers(markers));
  Set("solver", "nonlinear");
  Set("noise_position", "0.25");
  Set("noise_orientation", "0.5");
  EXPECT_FALSE(is_by_markers(markers));
  markers.measurement->marker_sigma = Eigen::Vector3d::Ones();
  EXPECT_TRUE(is_by_markers(markers));
  Set("evaluation", "per_pose");  // either residual has a reference
  EXPECT_TRUE(is_by_markers(markers));
  EXPECT_FALSE(is_by_markers(poses));
  EXPECT_EQ(HeaderOf("d", CalibrateOptionsFromFlags(), true).residual, "marker");
  EXPECT_EQ(HeaderOf("d", CalibrateOptionsFromFlags(), false).residual, "pose");
}

}  // namespace
}  // namespace hexcal
