// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_matrix.h"

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr double kRankThreshold = 1e-12;

}  // namespace

Matrix12d InverseOfNormal(const Matrix12d& normal, const Vector12d& column_norms) {
  const Vector12d scale =
      column_norms.unaryExpr([](double norm) { return norm > 0 ? 1.0 / norm : 1.0; });
  return scale.asDiagonal() *
         Matrix12d(
             PseudoInverse(scale.asDiagonal() * normal * scale.asDiagonal(), kRankThreshold)) *
         scale.asDiagonal();
}

Matrix12d InverseOfNormal(const Matrix12d& normal) {
  return InverseOfNormal(normal, normal.diagonal().cwiseSqrt());
}

}  // namespace hexcal
