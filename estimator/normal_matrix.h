// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/covariance.h"

namespace hexcal {

// Inverse of a 12 x 12 normal matrix on the directions that the data determine, zero on the others.
// column_norms: lengths of the columns of the Jacobian that it is made of; with them taken out,
// units do not matter. A direction is lost below a ratio of 1e-12, the square of
// CovarianceOptions::smallest_ratio.
Matrix12d InverseOfNormal(const Matrix12d& normal, const Vector12d& column_norms);

// The same for a symmetric one, whose diagonal holds the squared lengths.
Matrix12d InverseOfNormal(const Matrix12d& normal);

}  // namespace hexcal
