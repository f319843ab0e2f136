// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimator/estimate.h"

namespace hexcal {

// The iteration of the paper's Section 6: pose errors x(k), least squares for y in x = J y (Eq.
// 21), update of both mounts.
struct LinearizedOptions {
  enum class Error {
    kPaper,  // Eq. (22): difference of pose vectors [x y z rx ry rz]; angles taken in (-pi, pi]
    kTwist,  // measured [-] predicted: the motion that J really speaks of; converges quadratically
  };
  // How "the updated matrices should be made unit magnitude" (Section 6, step 5) is read. Paper's
  // error only; the twist update is exact and needs none.
  enum class UnitMagnitude {
    kApproachFirst,    // a normalised, o made orthogonal to it, n = o x a (the textbook habit;
                       // nearest to Table III)
    kNormalFirst,      // n normalised, o made orthogonal to it, a = n x o
    kNearestRotation,  // in the Frobenius norm (SVD)
    kColumns,          // each of n, o, a divided by its length
    kRows,             // each row divided by its length
  };

  Error error = Error::kTwist;
  UnitMagnitude unit_magnitude = UnitMagnitude::kApproachFirst;
  int max_iterations = 20;   // the paper's Section 7
  double tolerance = 1e-12;  // of the largest update, m and rad; never below the data's rounding
};

// weights: the whitener of each observation, or empty for equal weights (1 m against 1 rad) as in
// the paper. Not converged is a status, not an error. Cost in the records is half the weighted sum
// of squares of x.
Solution SolveLinearized(const std::vector<Observation>& observations,
                         const std::vector<Matrix6d>& weights,
                         const BaseAndTool& start,
                         const LinearizedOptions& options);

// d(x) / d(measured [-] predicted) at a perfect fit, 6 x 6: what the difference of pose vectors
// (Eq. 22) makes of a small motion. J does not have this factor; that is why the iteration with the
// paper's error converges linearly only.
Matrix6d PaperErrorDerivative(const Pose3d& predicted_world_from_tool);

}  // namespace hexcal
