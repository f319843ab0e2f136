// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"

namespace hexcal {

// The whitened rows of a linear problem, those of a pose (error, then shape) together: what a
// measurement of that pose would add. Poses' errors count as independent.
struct DesignRows {
  Eigen::MatrixXd nuisance;  // rows x base, tool and what else is fitted
  Eigen::MatrixXd columns;   // rows x columns of all forms
  std::vector<int> first;    // of each pose, and behind the last one

  int poses() const { return static_cast<int>(first.size()) - 1; }
};

// noise: of a problem whose poses are the first of these; later poses have its factors and the
// weight 1.
DesignRows MakeDesignRows(const LinearProblem& problem, const GapNoise& noise);

// Rows of these poses, in their order.
Eigen::MatrixXd RowsOf(const DesignRows& rows,
                       const Eigen::MatrixXd& m,
                       const std::vector<int>& poses);

}  // namespace hexcal
