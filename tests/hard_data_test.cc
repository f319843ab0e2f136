// SPDX-License-Identifier: BSD-3-Clause
// Data that are allowed but hard: every number that comes out is finite, what is solvable is solved
// from nothing, and what is not is said to be not.
#include <gtest/gtest.h>

#include "estimator/calibrate.h"
#include "estimator/start.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::KnownNoise;
using testing::SeededByTest;
using testing::UnknownNoise;

using Rows = std::vector<Observation>;

// Of the unit quaternions w, x, y, z.
Eigen::Quaterniond HalfTurn(int k) {
  const Eigen::Vector4d q = Eigen::Vector4d::Unit(k);
  return {q[0], q[1], q[2], q[3]};
}

// Sets the measured poses anew after the robot's have been changed.
void See(const BaseAndTool& truth, Rows* rows) {
  for (Observation& o : *rows)
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
}

CalibrateOptions Linearized(LinearizedOptions::Error error, std::optional<Start> start = {}) {
  CalibrateOptions options;
  options.solver = Solver::kLinearized;
  options.linearized.error = error;
  options.start = start;
  return options;
}

void ExpectFinite(const Estimate& e) {
  EXPECT_TRUE(e.mounts.world_from_base.Matrix().allFinite());
  EXPECT_TRUE(e.mounts.platform_from_tool.Matrix().allFinite());
  EXPECT_TRUE(e.covariance.allFinite() && e.covariance_unscaled.allFinite());
  EXPECT_TRUE(e.observability.singular_values.allFinite());
  for (const double x :
       {e.noise.position, e.noise.orientation, e.noise_scale, e.chi_square, e.rmspe, e.rmsoe})
    EXPECT_TRUE(std::isfinite(x)) << x;
  for (const IterationRecord& r : e.iterations)
    EXPECT_TRUE(std::isfinite(r.cost) && std::isfinite(r.rmspe) && std::isfinite(r.rmsoe));
  for (int i = 0; i < 12; ++i)
    EXPECT_TRUE(!e.observability.determined[i] || e.covariance(i, i) >= 0.0);
  EXPECT_GT(e.degrees_of_freedom, 0);
}

// In units of the reported standard deviations.
double LargestError(const Estimate& e, const BaseAndTool& truth) {
  return Difference(e.mounts, truth)
      .cwiseQuotient(e.covariance.diagonal().cwiseSqrt())
      .cwiseAbs()
      .maxCoeff();
}

// The four half turns commute: the rotations alone allow four bases, only the positions tell which.
template <typename Rng>
Rows HalfTurns(Rng& rng, const BaseAndTool& truth) {
  Rows rows = HexapodObservations(rng, truth, 12);
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k].base_from_platform.rotation = HalfTurn(static_cast<int>(k % 4));
  See(truth, &rows);
  return rows;
}

TEST(HardData, PosesThatDifferByHalfTurns) {
  auto rng = SeededByTest();
  for (const double noise : {0.0, 1.0}) {
    for (int i = 0; i < 20; ++i) {
      const BaseAndTool truth = AnyMounts(rng);
      Rows rows = HalfTurns(rng, truth);
      testing::AddNoise(rng, noise * Isotropic(1e-4, 1e-3), &rows);
      const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
      EXPECT_TRUE(e.IsTrustworthy());
      EXPECT_LT(e.rmspe, noise > 0 ? 3e-4 : 1e-12);
      EXPECT_LT(Difference(e.mounts, truth).norm(), noise > 0 ? 1e-2 : 1e-9);
    }
  }
}

// A start with another of the four bases either reaches the right one or is refused.
TEST(HardData, ALocalMinimumIsNotTakenForTheSolution) {
  auto rng = SeededByTest();
  int refused = 0;
  for (int i = 0; i < 20; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    const Observations observations = UnknownNoise(HalfTurns(rng, truth));
    const Pose3d turn{Eigen::Vector3d::Zero(), HalfTurn(1 + i % 3)};
    for (const Solver solver : {Solver::kNonlinear, Solver::kLinearized}) {
      CalibrateOptions options;
      options.solver = solver;
      options.start = Start::kInitial;
      const BaseAndTool initial = {truth.world_from_base * turn, turn * truth.platform_from_tool};
      const Estimate e = Calibrate(observations, initial, options);
      const double error = Difference(e.mounts, truth).norm();
      EXPECT_TRUE(!e.IsTrustworthy() || error < 1e-8) << error;
      refused += e.message.find("--start=closed_form") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_GT(refused, 0);  // else this has tested nothing
}

// Without noise the weights must not freeze a start that the rotations cannot tell from the truth.
TEST(HardData, OneAxisWithoutNoiseIsFittedToRounding) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    Rows rows = HexapodObservations(rng, truth, 20);
    for (Observation& o : rows)
      o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -1, 1)));
    See(truth, &rows);
    const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
    ExpectFinite(e);
    EXPECT_LT(e.rmspe, 1e-12);
    EXPECT_EQ(e.observability.null_directions, 1);
    EXPECT_FALSE(e.IsTrustworthy());
  }
}

TEST(HardData, ATrackerTenKilometresAway) {
  auto rng = SeededByTest();
  BaseAndTool truth = AnyMounts(rng);
  Rows rows = HexapodObservations(rng, truth, 20);
  truth.world_from_base.translation += Eigen::Vector3d(1e4, -1e4, 3e3);
  See(truth, &rows);
  testing::AddNoise(rng, Isotropic(1e-4, 1e-3), &rows);
  for (const CalibrateOptions& options :
       {CalibrateOptions(), Linearized(LinearizedOptions::Error::kTwist, Start::kClosedForm)}) {
    const Estimate e = Calibrate(UnknownNoise(rows), {}, options);
    EXPECT_TRUE(e.IsTrustworthy()) << e.message;
    EXPECT_LT(LargestError(e, truth), 5.0);
  }
}

// A milliradian of the base is ten metres of its origin: what is told is where the tool is.
TEST(HardData, ARobotThatWorksTenKilometresFromItsOrigin) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  Rows rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) o.base_from_platform.translation.x() += 1e4;
  See(truth, &rows);
  const Rows exact = rows;
  testing::AddNoise(rng, Isotropic(1e-4, 1e-3), &rows);
  const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
  EXPECT_TRUE(e.IsTrustworthy()) << e.message;
  for (const Observation& o : exact)
    EXPECT_LT(PoseError(e.mounts, o.base_from_platform, o.world_from_tool).norm(), 3e-3);
}

TEST(HardData, AnyScaleFromNanometresToTenThousandKilometres) {
  auto rng = SeededByTest();
  for (const double scale : {1e-8, 1e-5, 1e7}) {
    BaseAndTool truth = AnyMounts(rng);
    Rows rows = HexapodObservations(rng, truth, 20);
    truth.world_from_base.translation *= scale;
    truth.platform_from_tool.translation *= scale;
    for (Observation& o : rows) o.base_from_platform.translation *= scale;
    See(truth, &rows);
    testing::AddNoise(rng, Isotropic(1e-4 * scale, 1e-3), &rows);
    const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
    EXPECT_TRUE(e.IsTrustworthy()) << scale << " " << e.message;
    EXPECT_NEAR(e.noise.position / scale, 1e-4, 0.3e-4);
    EXPECT_LT(LargestError(e, truth), 5.0);
  }
}

TEST(HardData, MotionsOfAMicrometreAndTenMicroradians) {
  auto rng = SeededByTest();
  const BaseAndTool truth = {testing::RandomPose(rng, 2.0), testing::RandomPose(rng, 1e-6)};
  Rows rows = HexapodObservations(rng, truth, 20);
  for (Observation& o : rows) o.base_from_platform = testing::SmallPose(rng, 1e-6, 1e-5);
  See(truth, &rows);
  testing::AddNoise(rng, Isotropic(1e-10, 1e-8), &rows);
  const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
  EXPECT_TRUE(e.IsTrustworthy()) << e.message;
  EXPECT_LT(LargestError(e, truth), 5.0);
}

// Weights of 1e16 to 1: rounding of the cost must not look like no convergence.
TEST(HardData, NoiseOfVeryUnequalSize) {
  auto rng = SeededByTest();
  for (const auto& [position, orientation] : {std::pair{1e-9, 0.1}, std::pair{0.1, 1e-9}}) {
    const BaseAndTool truth = AnyMounts(rng);
    Rows rows = HexapodObservations(rng, truth, 20);
    const Matrix6d covariance = Isotropic(position, orientation);
    testing::AddNoise(rng, covariance, &rows);
    for (const Observations& observations : {UnknownNoise(rows), KnownNoise(rows, covariance)}) {
      const Estimate e = Calibrate(observations, {}, {});
      EXPECT_TRUE(e.IsTrustworthy()) << e.message;
      EXPECT_NEAR(e.noise.position / position, 1.0, 0.4);
      EXPECT_NEAR(e.noise.orientation / orientation, 1.0, 0.4);
      EXPECT_LT(LargestError(e, truth), 5.0);
    }
  }
}

// Six degrees of freedom are left, and all positions can be met exactly: the likelihood has no
// maximum inside.
TEST(HardData, ThreePosesThatBelongToNoMachine) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    Rows rows = HexapodObservations(rng, AnyMounts(rng), 3);
    for (Observation& o : rows) o.world_from_tool = testing::SmallPose(rng, 0.05, 0.3);
    ExpectFinite(Calibrate(UnknownNoise(rows), {}, {}));
  }
}

TEST(HardData, PosesThatHaveNothingToDoWithEachOtherAreRefused) {
  auto rng = SeededByTest();
  for (int i = 0; i < 5; ++i) {
    Rows rows = HexapodObservations(rng, AnyMounts(rng), 20);
    for (Observation& o : rows) o.world_from_tool = testing::RandomPose(rng, 1.0);
    const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
    ExpectFinite(e);
    EXPECT_FALSE(e.IsTrustworthy());
    EXPECT_FALSE(e.warnings.empty());
  }
}

TEST(HardData, PosesThatDoNotMoveLoseSixDirections) {
  auto rng = SeededByTest();
  for (const bool is_origin : {false, true}) {
    const BaseAndTool truth = is_origin ? BaseAndTool() : AnyMounts(rng);
    Rows rows = HexapodObservations(rng, truth, 10);
    for (Observation& o : rows)
      o.base_from_platform = is_origin ? Pose3d() : rows[0].base_from_platform;
    See(truth, &rows);
    const Estimate e = Calibrate(UnknownNoise(rows), {}, {});
    ExpectFinite(e);
    EXPECT_EQ(e.observability.null_directions, 6);
    EXPECT_FALSE(e.IsTrustworthy());
  }
}

// The paper's iteration from the identity, on mounts that it was not made for: no convergence, and
// a standard deviation of the size of what is left over.
TEST(HardData, ThePapersIterationThatDivergesSaysSoInFiniteNumbers) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    Rows rows = HexapodObservations(rng, AnyMounts(rng), 20);
    testing::AddNoise(rng, Isotropic(1e-4, 1e-3), &rows);
    const Estimate e =
        Calibrate(UnknownNoise(rows), {}, Linearized(LinearizedOptions::Error::kPaper));
    ExpectFinite(e);
    EXPECT_FALSE(e.IsTrustworthy());
    EXPECT_NEAR(e.noise.position * std::sqrt(3.0) / e.rmspe, 1.0, 1.0);
    EXPECT_LT(e.covariance.diagonal().maxCoeff(), 1e3 * std::max(1.0, e.rmspe * e.rmspe));
  }
}

// Equal weights of 1 m and 1 rad leave some of the orientation's noise in the positions: neither
// noise comes out negative, and no deviation astronomical.
TEST(HardData, ThePapersErrorWithNoiseOfVeryUnequalSize) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::PaperMounts();
  Rows rows = HexapodObservations(rng, truth, 20);
  testing::AddNoise(rng, Isotropic(1e-9, 0.1), &rows);
  CalibrateOptions options = Linearized(LinearizedOptions::Error::kPaper);
  options.linearized.max_iterations = 300;
  const Estimate e = Calibrate(UnknownNoise(rows), {}, options);
  ExpectFinite(e);
  EXPECT_TRUE(e.converged) << e.message;
  EXPECT_NEAR(e.noise.orientation, 0.1, 0.03);
  EXPECT_LT(e.covariance.diagonal().cwiseSqrt().maxCoeff(), 0.3);
  EXPECT_LT(LargestError(e, truth), 5.0);
}

// The noise is found along with the mounts within the paper's twenty iterations, from the identity
// and on noise of a real tracker's size.
TEST(HardData, TheTwistIterationConvergesWithinTwentyOnNoisyData) {
  auto rng = SeededByTest();
  for (int i = 0; i < 50; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    Rows rows = HexapodObservations(rng, truth, 60);
    testing::AddNoise(rng, Isotropic(4e-3, 7e-3), &rows);
    const Observations observations = UnknownNoise(rows);
    const Estimate e = Calibrate(
        observations, {}, Linearized(LinearizedOptions::Error::kTwist, Start::kClosedForm));
    EXPECT_TRUE(e.IsTrustworthy()) << e.message;
    EXPECT_LE(e.iterations.size(), 16u);
    EXPECT_NEAR(e.noise_scale, 1.0, 1e-7);
  }
}

// A stated robot noise that is far too large explains everything: nothing is left for the tool, and
// the doubt is said.
TEST(HardData, ARobotNoiseThatIsTooLargeLeavesNoneForTheTool) {
  auto rng = SeededByTest();
  Rows rows = HexapodObservations(rng, AnyMounts(rng), 20);
  testing::AddNoise(rng, Isotropic(1e-5, 1e-4), &rows);
  for (Observation& o : rows) o.robot_covariance = Isotropic(1e-4, 1e-3);
  Observations observations = UnknownNoise(rows);
  observations.has_robot_noise = true;
  const Estimate e = Calibrate(observations, {}, {});
  ExpectFinite(e);
  EXPECT_TRUE(e.converged) << e.message;
  ASSERT_EQ(e.warnings.size(), 1u);
  EXPECT_NE(e.warnings[0].find("smaller than the stated noise"), std::string::npos);
}

}  // namespace
}  // namespace hexcal
