// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/sandwich.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "estimator/normal_matrix.h"
#include "estimator/polish.h"
#include "residuals/whitener.h"
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

constexpr NoiseLevels kNoise = {1e-4, 2e-4};

// Weighted fit under a loss from near it, weights taken in turn with the fit.
BaseAndTool Fit(const std::vector<Observation>& rows,
                const Matrix6d& noise,
                const RobustLoss& loss,
                BaseAndTool mounts) {
  const Matrix6d whitener = WhitenerOf(noise);
  for (int k = 0; k < (loss.kind == LossKind::kNone ? 1 : 15); ++k) {
    std::vector<Matrix6d> whiteners;
    for (const Observation& o : rows) {
      double rho, weight;
      loss.Evaluate(
          (whitener * PoseError(mounts, o.base_from_platform, o.world_from_tool)).squaredNorm(),
          &rho,
          &weight);
      whiteners.push_back(std::sqrt(weight) * whitener);
    }
    mounts = Polish(rows, whiteners, mounts);
  }
  return mounts;
}

Matrix12d ModelCovariance(const std::vector<Observation>& rows,
                          const Matrix6d& noise,
                          const RobustLoss& loss,
                          const BaseAndTool& mounts) {
  Matrix12d normal = Matrix12d::Zero();
  for (const Observation& o : rows) {
    const LinearisedError e = Linearise(o, mounts);
    const Matrix6x12d j = WhitenerOf(noise) * e.jacobian;
    double rho, weight;
    loss.Evaluate((WhitenerOf(noise) * e.error).squaredNorm(), &rho, &weight);
    normal += weight * j.transpose() * j;
  }
  return InverseOfNormal(normal);
}

TEST(Sandwich, DoesNotCareHowLargeTheNoiseIsSaidToBe) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  std::vector<Observation> rows = HexapodObservations(rng, truth, 20);
  testing::AddNoise(rng, Isotropic(kNoise), &rows);
  const BaseAndTool fit = Fit(rows, Isotropic(kNoise), {}, truth);
  const Matrix12d once =
      SandwichCovariance(KnownNoise(rows, Isotropic(kNoise)), fit, {}, RobustLoss{});
  const Matrix12d seven =
      SandwichCovariance(KnownNoise(rows, 49.0 * Isotropic(kNoise)), fit, {}, RobustLoss{});
  EXPECT_TRUE(testing::MatrixNear(once / once.norm(), seven / once.norm(), 1e-10));
  // a level that is not known is taken from levels
  const Matrix12d by_levels =
      SandwichCovariance(testing::UnknownNoise(rows), fit, kNoise, RobustLoss{});
  EXPECT_TRUE(testing::MatrixNear(once / once.norm(), by_levels / once.norm(), 1e-10));
}

// Where the model holds it is unbiased: its mean over draws is the model's covariance.
TEST(Sandwich, IsUnbiasedWhereTheModelHolds) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const std::vector<Observation> exact = HexapodObservations(rng, truth, 15);
  const Matrix12d model = ModelCovariance(exact, Isotropic(kNoise), {}, truth);
  Vector12d ratio = Vector12d::Zero();
  constexpr int kDraws = 400;
  for (int k = 0; k < kDraws; ++k) {
    std::vector<Observation> rows = exact;
    testing::AddNoise(rng, Isotropic(kNoise), &rows);
    const Matrix12d sandwich = SandwichCovariance(KnownNoise(rows, Isotropic(kNoise)),
                                                  Fit(rows, Isotropic(kNoise), {}, truth),
                                                  {},
                                                  RobustLoss{});
    ratio += sandwich.diagonal().cwiseQuotient(model.diagonal()) / kDraws;
  }
  EXPECT_TRUE(testing::MatrixNear(ratio, Vector12d::Ones(), 0.08));
}

// The share of 95 % intervals that hold the truth, over all 12 parameters.
struct Coverage {
  double sandwich = 0.0, model = 0.0;
};

// noise: of pose i, by which its errors are drawn; the fit believes Isotropic(kNoise) of all.
template <typename Rng, typename NoiseFactor>
Coverage CoverageOf(Rng& rng, const RobustLoss& loss, const NoiseFactor& factor) {
  constexpr int kDraws = 250;
  constexpr double kSigmas = 1.96;
  const BaseAndTool truth = AnyMounts(rng);
  const std::vector<Observation> exact = HexapodObservations(rng, truth, 60);
  Coverage coverage;
  for (int k = 0; k < kDraws; ++k) {
    std::vector<Observation> rows;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      std::vector<Observation> one = {exact[i]};
      testing::AddNoise(rng, std::pow(factor(i, exact[i]), 2) * Isotropic(kNoise), &one);
      rows.push_back(one[0]);
    }
    const BaseAndTool fit = Fit(rows, Isotropic(kNoise), loss, truth);
    const Observations observations = KnownNoise(rows, Isotropic(kNoise));
    const Matrix12d sandwich = SandwichCovariance(observations, fit, {}, loss);
    const Matrix12d model = LossCovarianceFactor(observations, fit, {}, loss) *
                            ModelCovariance(rows, Isotropic(kNoise), loss, fit);
    const Vector12d error = Difference(fit, truth).cwiseAbs();
    const auto covered = [&](const Matrix12d& covariance) {
      return (error.array() < kSigmas * covariance.diagonal().array().sqrt()).count() /
             (12.0 * kDraws);
    };
    coverage.sandwich += covered(sandwich);
    coverage.model += covered(model);
  }
  return coverage;
}

// Poses far from the middle of the travel four times as noisy, which tell most: what the model
// promises, noise scale and all, is not kept.
TEST(Sandwich, CoversWhereNoiseDiffersFromPoseToPose) {
  auto rng = SeededByTest();
  const Coverage coverage = CoverageOf(rng, RobustLoss{}, [](std::size_t, const Observation& o) {
    return Log(o.base_from_platform.rotation).norm() > 0.3 ? 4.0 : 1.0;
  });
  EXPECT_NEAR(coverage.sandwich, 0.95, 0.025);
  EXPECT_LT(coverage.model, coverage.sandwich - 0.015);
}

TEST(Sandwich, CoversWithEveryLossAndSoDoesTheFactor) {
  auto rng = SeededByTest();
  for (const LossKind kind : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    // one in ten is three times as noisy
    const Coverage coverage =
        CoverageOf(rng, DefaultLoss(kind), [](std::size_t i, const Observation&) {
          return i % 10 == 0 ? 3.0 : 1.0;
        });
    EXPECT_NEAR(coverage.sandwich, 0.95, 0.025) << static_cast<int>(kind);
    EXPECT_NEAR(coverage.model, 0.95, 0.025) << static_cast<int>(kind);
  }
}

TEST(Sandwich, WithoutALossTheFactorIsChiSquareOverDegreesOfFreedom) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  std::vector<Observation> rows = HexapodObservations(rng, truth, 10);
  testing::AddNoise(rng, Isotropic(kNoise), &rows);
  const BaseAndTool fit = Fit(rows, Isotropic(kNoise), {}, truth);
  double chi_square = 0.0;
  for (const Observation& o : rows)
    chi_square +=
        (WhitenerOf(Isotropic(kNoise)) * PoseError(fit, o.base_from_platform, o.world_from_tool))
            .squaredNorm();
  EXPECT_NEAR(LossCovarianceFactor(KnownNoise(rows, Isotropic(kNoise)), fit, {}, RobustLoss{}),
              chi_square / (60.0 - 12.0),
              1e-12);
}

}  // namespace
}  // namespace hexcal
