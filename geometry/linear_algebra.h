// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// Dense decompositions behind plain functions, for any size: Eigen's templates take long to
// compile, and longest for fixed sizes, so each is made here once. For loops over poses use Eigen's
// own fixed-size solvers.

// m = u diag(singular_values) v', full u and v, largest first.
struct SingularValues {
  Eigen::VectorXd singular_values;
  Eigen::MatrixXd u, v;
};
SingularValues Decompose(const Eigen::MatrixXd& m);

// Symmetric m = vectors diag(values) vectors', smallest first.
struct Eigenvalues {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
Eigenvalues DecomposeSymmetric(const Eigen::MatrixXd& m);

// Moore-Penrose inverse; pivots below threshold times the largest count as zero.
Eigen::MatrixXd PseudoInverse(const Eigen::MatrixXd& m, double threshold);

// The shortest x that minimises |a x - b|, with the threshold of PseudoInverse.
Eigen::VectorXd ShortestSolution(const Eigen::MatrixXd& a,
                                 const Eigen::VectorXd& b,
                                 double threshold);

// The upper triangular n x n factor R of a = Q R, a with n columns and at least as many rows.
Eigen::MatrixXd TriangularFactor(const Eigen::MatrixXd& a);

// Orthonormal columns that span those of a, whatever their units: columns are scaled to length one
// first, pivots below threshold count as zero. Rows x rank.
Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& a, double threshold);

}  // namespace hexcal
