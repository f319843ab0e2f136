// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "geometry/pose.h"

namespace hexcal {

// A form that a missing effect may take, linear in its coefficients: columns [first, first + size)
// of a problem. Forms of one family answer the same question ("which leg?", "which period?") and
// share the family's name.
struct Form {
  int family = 0;
  std::vector<int> index;  // legs, joints or markers, from 1
  int first = 0, size = 0;
  double log_prior = 0.0;  // of this form within its family: the search is paid for here
  int definition = 0;      // what it is: an index into the maker's list
};

struct Family {
  std::string name;
  double log_prior = 0.0;       // against the other families
  bool is_described = false;    // a description (site, driver, shape) under no name of its own
  bool is_last_resort = false;  // so wide that it explains whatever others do: taken only where no
                                // other is good enough
};

// The disagreement of all measured poses at one machine, with what may explain it, to first order:
//   error = nuisance * x + columns * c + noise,
// for poses (6 rows each, [m, rad], frame T, not whitened) and, with markers, for their misfit
// within the bodies (shape rows, whitened by the stated noise of a reading).
struct LinearProblem {
  int poses = 0;
  Eigen::VectorXd error;     // 6 poses
  Eigen::MatrixXd nuisance;  // 6 poses x 12, or more: base, tool and effects already there
  // 6 poses x all forms' columns; shared, for they are many and never change.
  std::shared_ptr<const Eigen::MatrixXd> columns;

  // The covariance of a pose's error is a sum of these with unknown factors: components[c][pose].
  // The first has the factor 1 where the noise is stated rightly.
  std::vector<std::vector<Matrix6d>> components;
  // Of each component: a noise of a smaller factor is the rounding of the data and tells nothing.
  std::vector<double> least_factor;

  // Shape rows: shape_pose tells the pose of each. Only columns of tracker and marker effects are
  // not zero; shape_columns has one column for each that shape_of points to (-1: zero).
  std::vector<int> shape_pose;
  Eigen::VectorXd shape_error;
  Eigen::MatrixXd shape_nuisance;  // as wide as nuisance
  std::shared_ptr<const Eigen::MatrixXd> shape_columns;
  std::vector<int> shape_of;
  std::vector<int> shape_freedom;  // rows less the six numbers of each body, by pose
  // By pose: coordinates of all markers (3 each, whitened) x shape rows. Two poses' rows are of
  // different combinations of markers; these tell how they hang together.
  std::vector<Eigen::MatrixXd> shape_basis;
  Eigen::MatrixXd shape_trend;  // what may look like correlated shapes: markers off, and moving

  Eigen::VectorXd scale;  // of each column: the prior 1-sigma of its coefficient
  std::vector<Form> forms;
  std::vector<Family> families;

  // The problem of some of the poses, in their order.
  LinearProblem Restricted(const std::vector<int>& poses) const;
  // With these forms among the nuisances.
  LinearProblem With(const std::vector<int>& forms) const;
  // With one form alone to test: these forms' columns together.
  LinearProblem Only(const std::vector<int>& forms) const;
};

}  // namespace hexcal
