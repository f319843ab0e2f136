// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "discovery/design_rows.h"

namespace hexcal {

// A least-squares problem that grows pose by pose, whitened: rows as in DesignRows.
struct DesignModel {
  Eigen::MatrixXd columns;  // rows x unknowns
  Eigen::VectorXd signal;   // what the unknowns may not explain; empty: the unknowns are asked for
  int nuisances = 0;        // of the unknowns, the first are not asked for
  Eigen::VectorXd prior;    // information on each unknown beforehand; empty: none
};

// What some poses say of a model, and what one more would.
//   With a signal: the squared distance |(I - P) signal|^2 that no choice of the unknowns explains
//   (T-optimality; Atkinson and Fedorov 1975).
//   Without: the log determinant of the information on the unknowns asked for, the nuisances
//   projected out (D_s-optimality).
// A ridge of a billionth of the information of all rows keeps what is not determined finite.
class DesignState {
 public:
  // Both are referred to.
  DesignState(const DesignModel& model, const DesignRows& rows, const std::vector<int>& poses);

  double value() const { return value_; }
  double With(int pose) const;

 private:
  double LogDeterminant(Eigen::Index from) const;

  const DesignModel& model_;
  const DesignRows& rows_;
  Eigen::VectorXd scale_;  // of the unknowns
  Eigen::LLT<Eigen::MatrixXd> root_;
  Eigen::VectorXd explained_;  // by the scaled unknowns
  double value_ = 0.0;
};

}  // namespace hexcal
