// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/deletion.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "residuals/whitener.h"

namespace hexcal {
namespace {

// Part of a pose's variance, the least along any direction, that the fit must leave to it.
constexpr double kSmallestShare = 1e-6;

}  // namespace

double DeletionError::Squared() const { return error.dot(covariance.llt().solve(error)); }

double DeletionError::SigmasOf(int first) const {
  const Eigen::Vector3d e = error.segment<3>(first);
  const Eigen::Matrix3d c = covariance.block<3, 3>(first, first);
  return std::sqrt(e.dot(c.llt().solve(e)));
}

std::optional<DeletionError> ErrorAgainstOthers(const LinearisedError& at_fit,
                                                const Matrix6d& noise,
                                                const Matrix12d& fit_covariance,
                                                bool is_in_fit) {
  const Matrix6d of_fit = at_fit.jacobian * fit_covariance * at_fit.jacobian.transpose();
  if (!is_in_fit) return DeletionError{at_fit.error, noise + of_fit};
  return ErrorWithout(at_fit.error, noise, of_fit);
}

std::optional<DeletionError> ErrorWithout(const Vector6d& error,
                                          const Matrix6d& noise,
                                          const Matrix6d& of_fit) {
  const Matrix6d whitener = WhitenerOf(noise);
  const Matrix6d left = Matrix6d::Identity() - whitener * of_fit * whitener.transpose();
  const Eigen::LLT<Matrix6d> factor(left);
  if (factor.info() != Eigen::Success ||
      !(factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() > kSmallestShare))
    return std::nullopt;
  const Matrix6d unwhiten = noise * whitener.transpose();  // whitener^-1
  return DeletionError{unwhiten * factor.solve(whitener * error),
                       unwhiten * factor.solve(unwhiten.transpose())};
}

}  // namespace hexcal
