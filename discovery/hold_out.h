// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "discovery/discovery.h"
#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"
#include "discovery/select.h"

namespace hexcal {

// Poses of each fold: every run of `folds` neighbours is dealt out in a drawn order, so that each
// fold covers the whole time and no fold has two poses side by side by design.
std::vector<std::vector<int>> HoldOutFolds(int poses, int folds, std::uint64_t seed);
std::vector<int> AllBut(int poses, const std::vector<int>& left_out);
// The noise of the whole data for some of its poses.
GapNoise RestrictedNoise(const GapNoise& noise, const std::vector<int>& poses);

// What a model that never saw a pose says of it: base and tool alone, and the model grown by the
// same selection, repeated inside every fold (choosing once on all data would flatter: on clean
// data it shows an improvement four times out of five).
struct HeldOut {
  GapSize before, after;
  std::vector<double> after_steps;  // RMS of position with the first 0, 1, ... effects of all data
  int folds_agreeing = 0;           // on the families of the whole data
};

HeldOut HoldOut(const LinearProblem& problem,
                const Eigen::MatrixXd& trend,
                const Selection& whole,
                int folds,
                std::uint64_t seed,
                const std::function<void(int done)>& progress);

// The size of residuals (6 a pose, [m, rad]), whitened by the noise.
GapSize SizeOf(const LinearProblem& problem,
               const GapNoise& noise,
               const Eigen::VectorXd& residual,
               int parameters);

}  // namespace hexcal
