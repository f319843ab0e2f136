// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <functional>

#include "geometry/pose.h"

namespace hexcal::testing {

// Every entry within an absolute tolerance; NaN and different sizes fail.
template <typename A, typename B>
::testing::AssertionResult MatrixNear(const Eigen::MatrixBase<A>& actual,
                                      const Eigen::MatrixBase<B>& expected,
                                      double tolerance) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols())
    return ::testing::AssertionFailure() << "sizes differ";
  const double error =
      actual.size() == 0 ? 0.0 : (actual.derived() - expected.derived()).cwiseAbs().maxCoeff();
  const bool finite = actual.derived().allFinite() && expected.derived().allFinite();
  if (finite && error <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "largest difference " << error << " above " << tolerance << "\nactual:\n"
         << actual << "\nexpected:\n"
         << expected;
}

// Translation and rotation apart, m and rad; NaN fails. q and -q are the same rotation.
inline ::testing::AssertionResult PoseNear(const Pose3d& actual,
                                           const Pose3d& expected,
                                           double tolerance_m,
                                           double tolerance_rad) {
  const Vector6d d = Minus(actual, expected);
  const double m = d.head<3>().norm(), rad = d.tail<3>().norm();
  if (m <= tolerance_m && rad <= tolerance_rad) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "poses differ by " << m << " m and " << rad << " rad";
}

// Central differences of f over steps in each of n directions. f maps a step (n) to a vector (m).
// Shape m x n.
inline Eigen::MatrixXd NumericJacobian(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f, int n, double step = 1e-6) {
  Eigen::MatrixXd jacobian;
  for (int i = 0; i < n; ++i) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
    d[i] = step;
    const Eigen::VectorXd column = (f(d) - f(-d)) / (2 * step);
    if (i == 0) jacobian.resize(column.size(), n);
    jacobian.col(i) = column;
  }
  return jacobian;
}

// Absolute below 1 and relative above; NaN fails.
inline ::testing::AssertionResult JacobianNear(const Eigen::MatrixXd& analytic,
                                               const Eigen::MatrixXd& numeric,
                                               double tolerance) {
  if (analytic.rows() != numeric.rows() || analytic.cols() != numeric.cols())
    return ::testing::AssertionFailure() << "sizes differ";
  const double error =
      ((analytic - numeric).array().abs() / numeric.array().abs().max(1.0)).maxCoeff();
  if (analytic.allFinite() && numeric.allFinite() && error <= tolerance)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "Jacobians differ by " << error << "\nanalytic:\n"
                                       << analytic << "\nnumeric:\n"
                                       << numeric;
}

}  // namespace hexcal::testing
