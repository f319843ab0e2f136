// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/robust_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace hexcal {
namespace {

constexpr LossKind kKinds[] = {
    LossKind::kNone, LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey};
constexpr LossKind kRobust[] = {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey};

double Rho(const RobustLoss& loss, double s) {
  double rho, weight;
  loss.Evaluate(s, &rho, &weight);
  return rho;
}

double Weight(const RobustLoss& loss, double s) {
  double rho, weight;
  loss.Evaluate(s, &rho, &weight);
  return weight;
}

TEST(RobustLoss, IsTheSquareNearZero) {
  for (const LossKind kind : kKinds)
    for (const double s : {0.0, 1e-12, 1e-9}) {
      EXPECT_NEAR(Rho(DefaultLoss(kind), s), s, 1e-6 * s);
      EXPECT_NEAR(Weight(DefaultLoss(kind), s), 1.0, 1e-7);
    }
}

TEST(RobustLoss, WeightIsTheDerivative) {
  for (const LossKind kind : kKinds)
    for (const double s : {0.1, 1.0, 3.0, 5.0, 20.0, 35.0, 50.0, 1e3}) {
      const RobustLoss loss = DefaultLoss(kind);
      const double step = 1e-6 * s;
      const double numeric = (Rho(loss, s + step) - Rho(loss, s - step)) / (2.0 * step);
      EXPECT_NEAR(Weight(loss, s), numeric, 1e-8) << static_cast<int>(kind) << " " << s;
    }
}

// By hand at scale 2, s = 9: Huber 2*2*3 - 4 = 8; Cauchy 4 log(1 + 9/4); Tukey 4/3 beyond the
// scale, and at s = 1: 4/3 (1 - (3/4)^3) = 37/48.
TEST(RobustLoss, HandWorkedValues) {
  EXPECT_DOUBLE_EQ(Rho({LossKind::kNone, 2.0}, 9.0), 9.0);
  EXPECT_DOUBLE_EQ(Rho({LossKind::kHuber, 2.0}, 9.0), 8.0);
  EXPECT_DOUBLE_EQ(Weight({LossKind::kHuber, 2.0}, 9.0), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(Rho({LossKind::kCauchy, 2.0}, 9.0), 4.0 * std::log(3.25));
  EXPECT_DOUBLE_EQ(Weight({LossKind::kCauchy, 2.0}, 9.0), 4.0 / 13.0);
  EXPECT_DOUBLE_EQ(Rho({LossKind::kTukey, 2.0}, 9.0), 4.0 / 3.0);
  EXPECT_EQ(Weight({LossKind::kTukey, 2.0}, 9.0), 0.0);
  EXPECT_DOUBLE_EQ(Rho({LossKind::kTukey, 2.0}, 1.0), 37.0 / 48.0);
  EXPECT_DOUBLE_EQ(Weight({LossKind::kTukey, 2.0}, 1.0), 9.0 / 16.0);
}

TEST(RobustLoss, IsThatOfCeres) {
  EXPECT_EQ(CeresLoss(DefaultLoss(LossKind::kNone)), nullptr);
  for (const LossKind kind : kRobust)
    for (const double scale : {0.5, 1.0, 6.0})
      for (const double s : {0.0, 0.1, 0.25, 1.0, 3.0, 35.9, 36.0, 36.1, 1e6}) {
        const RobustLoss loss{kind, scale};
        double of_ceres[3];
        CeresLoss(loss)->Evaluate(s, of_ceres);
        EXPECT_NEAR(Rho(loss, s), of_ceres[0], 1e-13 * (1.0 + s));
        EXPECT_NEAR(Weight(loss, s), of_ceres[1], 1e-14);
        EXPECT_NEAR(loss.Curvature(s), of_ceres[2], 1e-14);
      }
}

// Simpson's rule over [from, to].
double Integral(const std::function<double(double)>& f, double from, double to) {
  constexpr int kIntervals = 4000;
  const double step = (to - from) / kIntervals;
  double sum = f(from) + f(to);
  for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + i * step);
  return sum * step / 3.0;
}

// E[w + r w' / 6]^2 / E[w^2 r^2 / 6]; r has the density r^5 exp(-r^2 / 2) / 8.
double Efficiency(const RobustLoss& loss) {
  const auto density = [](double r) { return std::pow(r, 5) * std::exp(-0.5 * r * r) / 8.0; };
  const auto psi_slope = [&](double r) {  // w + r dw/dr / 6, dw/dr = 2 r rho''
    return (Weight(loss, r * r) + r * r * loss.Curvature(r * r) / 3.0) * density(r);
  };
  const auto psi_square = [&](double r) {
    return std::pow(Weight(loss, r * r) * r, 2) / 6.0 * density(r);
  };
  // The weight has a corner at the scale.
  constexpr double kFar = 12.0, kCorner = 1e-6;
  const double corner = loss.scale;
  const auto both = [&](const std::function<double(double)>& f) {
    return Integral(f, 0.0, corner - kCorner) + Integral(f, corner + kCorner, kFar);
  };
  return std::pow(both(psi_slope), 2) / both(psi_square);
}

TEST(RobustLoss, DefaultScalesAre95PercentEfficient) {
  for (const LossKind kind : kRobust) {
    EXPECT_NEAR(Efficiency(DefaultLoss(kind)), 0.95, 1e-5);
    EXPECT_LT(Efficiency({kind, 0.9 * DefaultLoss(kind).scale}), 0.949);
    EXPECT_GT(Efficiency({kind, 1.1 * DefaultLoss(kind).scale}), 0.951);
  }
}

}  // namespace
}  // namespace hexcal
