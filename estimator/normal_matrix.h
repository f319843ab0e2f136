// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "residuals/streamed_residual.h"

namespace hexcal {

// Inverse of a p x p normal matrix on the directions that the data determine, zero on the others.
// column_norms: lengths of the columns of the Jacobian that it is made of; with them taken out,
// units do not matter. A direction is lost below a ratio of 1e-12, the square of
// CovarianceOptions::smallest_ratio.
Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal, const Eigen::VectorXd& column_norms);

// The same for a symmetric one, whose diagonal holds the squared lengths.
Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal);

// Whether squaring the rows has kept what they say of the weakest direction: it has seven digits
// left, the singular values of the rows differing by less than 1e4.
bool KeepsItsWeakest(const Eigen::MatrixXd& normal);

// The step to the minimum of the linearised residuals, the shortest where directions are lost.
Eigen::VectorXd GaussNewtonStep(const NormalEquations& equations);

}  // namespace hexcal
