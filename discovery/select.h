// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"
#include "discovery/score.h"

namespace hexcal {

struct SelectOptions {
  double alpha = 0.01;  // family-wise, of the first step; halved for each further one
  int bootstraps = 999;
  int most_effects = 4;
  std::uint64_t seed = 1;
  // In place of bootstraps: a family is taken where its -log10 p is above its own threshold.
  // For folds of a held-out test, which repeat a selection whose thresholds are known.
  std::vector<double> thresholds;
  std::function<void(int step)> progress;
};

struct SelectionStep {
  std::vector<Scorer::FamilyScore> families;  // best first, given what was chosen before
  std::vector<double> paid;                   // -log10 p of each of them, its search paid for
  std::vector<double> p_values;               // of each of them, all families paid for
  int added = -1;                             // form; -1: nothing more
  double p_value = 1.0;                       // family-wise
};

struct Selection {
  std::vector<int> chosen;       // forms
  std::vector<double> p_values;  // family-wise, when each was found
  std::vector<double> log10_p;   // of its own test, all others given
  std::vector<SelectionStep> steps;
  GapNoise noise;                  // with what was chosen in the model
  std::vector<double> thresholds;  // -log10 p that a family needs at alpha, first step
};

// Forward selection by evidence behind a family-wise gate: the noise is estimated with the best
// form in the model, so that a gap does not hide in it; after each step every form is chosen anew
// given the others, other pairs are tried in place of the two best, and what is no longer needed
// is dropped.
Selection Select(const LinearProblem& problem,
                 const Eigen::MatrixXd& trend,
                 const SelectOptions& options);

}  // namespace hexcal
