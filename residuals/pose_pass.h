// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "residuals/pose_batch.h"
#include "residuals/pose_error.h"
#include "residuals/robust_loss.h"

namespace hexcal {

// A stretch of a batch, and what to do with it.
struct PassInput {
  const PoseBatch::Block* poses;
  const PoseWeights::Block* weights;  // one a block of poses; one for all where is_common
  bool is_common;
  int blocks;
  int lanes_in_last;  // of the last block; the others are full
  const BaseAndTool* mounts;
  const RobustLoss* loss;
};

// What every pass sums beside its equations.
struct PassTotals {
  double rho = 0.0;  // of rho(s), s the squared norm of a pose's whitened error
  double position_squares = 0.0, orientation_squares = 0.0;  // not weighted, m^2 and rad^2

  void Add(const PassTotals& other);
};

// Sums over poses for one level of position noise and one of orientation noise: J' J and J' e of
// each part at weight one, so that levels may change without another pass. A pose counts by its
// robust weight.
struct IsotropicSums {
  struct Part {
    Matrix12d normal = Matrix12d::Zero();
    Vector12d gradient = Vector12d::Zero();
    double squares = 0.0;  // e' e
    double weights = 0.0;  // how many poses that is
  };
  Part position, orientation;
  PassTotals totals;

  void Add(const IsotropicSums& other);
};
IsotropicSums PassIsotropic(const PassInput& input,
                            double position_weight,
                            double orientation_weight);

// The same for any weights.
struct WeightedSums {
  Matrix12d normal = Matrix12d::Zero();    // J' W J
  Vector12d gradient = Vector12d::Zero();  // J' W e
  PassTotals totals;

  void Add(const WeightedSums& other);
};
WeightedSums PassWeighted(const PassInput& input);

}  // namespace hexcal
