// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/sandwich.h"

#include <algorithm>
#include <cmath>

#include "estimator/normal_matrix.h"
#include "geometry/linear_algebra.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// Part of a residual's variance that the fit leaves to it, at the least.
constexpr double kSmallestShare = 1e-3;

// A pose's whitened residual and Jacobian, and its part of bread and weights.
struct Whitened {
  Vector6d residual;
  Matrix6x12d jacobian;
  double squared = 0.0, weight = 1.0;
  double slope = 1.0;  // of weight * residual by the residual, the mean over directions
};

class Rows {
 public:
  Rows(const Observations& observations,
       const BaseAndTool& mounts,
       const NoiseLevels& levels,
       const RobustLoss& loss)
      : observations_(observations), mounts_(mounts), levels_(levels), loss_(loss) {}

  template <typename Use>
  void ForEach(const Use& use) const {
    for (const Observation& o : observations_.items) {
      const LinearisedError e = Linearise(o, mounts_);
      const Matrix6d whitener =
          WhitenerOf(ErrorCovariance(o, observations_, mounts_.platform_from_tool, levels_));
      Whitened row{whitener * e.error, whitener * e.jacobian};
      row.squared = row.residual.squaredNorm();
      double rho;
      loss_.Evaluate(row.squared, &rho, &row.weight);
      row.slope = row.weight + row.squared * loss_.Curvature(row.squared) / 3.0;
      use(row);
    }
  }

 private:
  const Observations& observations_;
  const BaseAndTool& mounts_;
  const NoiseLevels& levels_;
  const RobustLoss& loss_;
};

// residual / sqrt(1 - leverage), the symmetric root of the 6 x 6.
Vector6d WithoutLeverage(const Whitened& row, const Matrix12d& covariance) {
  const Matrix6d left =
      Matrix6d::Identity() - row.weight * row.jacobian * covariance * row.jacobian.transpose();
  const Eigenvalues eigen = DecomposeSymmetric(left);
  const Vector6d root = eigen.values.cwiseMax(kSmallestShare).cwiseSqrt().cwiseInverse();
  return eigen.vectors * root.asDiagonal() * eigen.vectors.transpose() * row.residual;
}

}  // namespace

Matrix12d SandwichCovariance(const Observations& observations,
                             const BaseAndTool& mounts,
                             const NoiseLevels& levels,
                             const RobustLoss& loss) {
  const Rows rows(observations, mounts, levels, loss);
  Matrix12d weighted = Matrix12d::Zero(), slopes = Matrix12d::Zero();
  rows.ForEach([&](const Whitened& row) {
    const Matrix12d square = row.jacobian.transpose() * row.jacobian;
    weighted += row.weight * square;
    slopes += row.slope * square;
  });
  const Matrix12d covariance = InverseOfNormal(weighted);
  const Matrix12d bread = InverseOfNormal(slopes, weighted.diagonal().cwiseSqrt());
  Matrix12d filling = Matrix12d::Zero();
  rows.ForEach([&](const Whitened& row) {
    const Vector12d gradient =
        row.weight * row.jacobian.transpose() * WithoutLeverage(row, covariance);
    filling += gradient * gradient.transpose();
  });
  return bread * filling * bread.transpose();
}

double LossCovarianceFactor(const Observations& observations,
                            const BaseAndTool& mounts,
                            const NoiseLevels& levels,
                            const RobustLoss& loss) {
  double squares = 0.0, slopes = 0.0, weights = 0.0;
  Rows(observations, mounts, levels, loss).ForEach([&](const Whitened& row) {
    squares += row.weight * row.weight * row.squared / 6.0;
    slopes += row.slope;
    weights += row.weight;
  });
  return squares / (1.0 - 2.0 / weights) * weights / (slopes * slopes);
}

}  // namespace hexcal
