// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "discovery/joint_fit.h"

namespace hexcal {

// A direction among an effect's numbers is told by the data where they bring its variance below
// this part of its prior's; under kWidePrior that is ten plausible sizes or better.
inline constexpr double kToldVariance = 0.1;

// What the data alone say of an effect, its prior taken out again: least squares along the
// directions that they tell, zero along the others.
struct ToldPart {
  int directions = 0, told = 0;
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd root;      // covariance of the coefficients: root * root'; a column a direction
  Eigen::MatrixXd response;  // of the mounts to the coefficients: they take so much of each

  double StandardUncertainty(Eigen::Index coefficient) const {
    return root.row(coefficient).norm();
  }
};

// fit: of one form; prior: 1-sigma of each coefficient in it, zero-mean. at_least: so many
// directions, the best told ones, count as told in any case.
ToldPart ToldPartOf(const JointFit& fit, const Eigen::VectorXd& prior, int at_least);

}  // namespace hexcal
