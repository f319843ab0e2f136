// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "residuals/streamed_residual.h"

namespace hexcal {

// Variances of the components at which the restricted likelihood (REML) of the residuals is
// largest, so that the p fitted parameters do not make them too small. The components' sums are
// linear in the parameters: what a better fit would take from them is taken, so that they need not
// stem from the best one. Reference: Searle, Casella, McCulloch, Variance Components (1992), ch. 6.
struct Variances {
  Eigen::VectorXd values;
  Eigen::MatrixXd information;  // of the restricted likelihood by the values, at them
};

// start, floor: one value a component, above 0; a component of which nothing is left over by the
// fit stays as it was.
Variances EstimateVariances(const std::vector<VarianceComponent>& components,
                            const Eigen::VectorXd& start,
                            const Eigen::VectorXd& floor);

// The equations that the components make at these variances; squared_norm by them too.
void SetVariances(const Eigen::VectorXd& variances, NormalEquations* equations);

}  // namespace hexcal
