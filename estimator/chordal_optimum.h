// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/chordal_cost.h"
#include "residuals/pose_error.h"

namespace hexcal {

// A stationary point of a ChordalCost over all rotations and translations, and what its dual
// proves of it. With the translations eliminated the cost is w' F w, w = [vec Z, vec R, 1], Z'Z =
// R'R = 1. The multipliers of these constraints follow from stationarity: with the gradients [G_Z,
// G_R, g] = F w they are Z'G_Z, R'G_R and g. For S = F - diag(multipliers) S w = 0, and any other
// point u has u' F u = w' F w + u' S u, |u|^2 = 7: where S has no negative eigenvalue nothing
// anywhere is better. (A stationary point that is none of these has one; at large noise the best
// one may, too, so that not proven does not mean wrong.)
struct ChordalOptimum {
  BaseAndTool mounts;
  double cost = 0.0;                 // with weights 1/sigma^2 a chi-square
  double lower_bound = 0.0;          // of the cost, over all base and tool
  double gap = 0.0;                  // (cost - lower_bound) / cost: 0 but for rounding where proven
  double smallest_eigenvalue = 0.0;  // of S / sum of orientation weights, but for w's own 0
  bool is_stationary = false;
  bool is_unique = false;  // translations determined, and no second point with the same cost
  bool is_best = false;    // proven: no base and tool anywhere leave a smaller cost
  double rounding = 0.0;   // of the cost
};

// Descends from start (Newton's method in the form alone: no pass over the poses) and judges where
// it ends.
ChordalOptimum FindChordalOptimum(const ChordalCost& cost, const BaseAndTool& start);

}  // namespace hexcal
