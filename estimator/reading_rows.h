// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "residuals/marker_data.h"

namespace hexcal {

// The marker readings of one pose at a solution, linearised one by one: whitened residual =
// residual - globals * (what is common to the poses, in MarkerLayout's order) - own * (what this
// pose alone has to be estimated for). Three rows a reading.
struct ReadingRows {
  int first = 0;                       // reading of the first three rows
  std::vector<Eigen::Vector3d> sigma;  // of each mean reading, m
  Eigen::VectorXd residual;
  Eigen::MatrixXd globals;
  Eigen::MatrixXd own;
  int draws = 0;         // the last columns of own: robot draws, with a prior of one
  Eigen::VectorXd draw;  // where they stand

  int readings() const { return static_cast<int>(sigma.size()); }
};

// is_cut: the tool is to stand anywhere; nothing but its own body then checks a reading of it.
// The model and its unknowns: residuals/marker_batch.h. unknowns: of the data, at a solution.
ReadingRows LineariseReadings(const MarkerData& data,
                              const MarkerUnknowns& unknowns,
                              const Eigen::Vector3d& sigma,
                              const MarkerPose& pose,
                              bool is_cut);

}  // namespace hexcal
