// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "estimator/observations.h"

namespace hexcal {

struct Estimate;

// Whether a solution is the best there is anywhere, not just among its neighbours. What can be
// proven so is the problem with one weight for the three coordinates of a pose and one for its
// three angles (ChordalOptimum): it is solved from the solution downhill, that optimum is judged,
// and the solution must not stand far from it.
struct Certificate {
  bool certified = false;
  // Of the dual matrix, over the sum of the weights of the angles, but for the 0 of the optimum
  // itself: positive where it is proven and unique.
  double smallest_eigenvalue = 0.0;
  // By which part the weighted sum of squares could be smaller elsewhere. Where exact, that of the
  // solution itself, angles as they are; else that of the optimum with one weight each.
  double gap = 0.0;
  // The solution's own weights are of this kind: what is proven holds for its own chi-square.
  bool exact = false;
  // Largest of the 12 differences between solution and that optimum, in standard deviations.
  double distance = 0.0;
  std::string why;  // in words, either way
};

// levels: of the tool noise where the observations do not know it. The estimate must have been
// judged; of its poses the weights count. One pass over the poses.
Certificate Certify(const Observations& observations,
                    const NoiseLevels& levels,
                    const Estimate& estimate);

// The levels that an estimate was weighted with: given, its own, or none where the observations
// know the noise.
NoiseLevels LevelsOf(const Observations& observations,
                     const std::optional<NoiseLevels>& given,
                     const Estimate& estimate);

}  // namespace hexcal
