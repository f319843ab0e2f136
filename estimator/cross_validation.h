// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "estimator/method.h"

namespace hexcal {

// How well base and tool from some poses predict the others.
struct HeldOutError {
  double position = 0.0;     // root mean square length over all poses, each predicted once, m
  double orientation = 0.0;  // rad
  int not_converged = 0;     // fits
};

// Which fold each of the poses falls to: folds of equal size but for one, drawn from the seed.
// Fewer poses than folds: one a fold. Empty where a fit would be left with less than three poses.
std::vector<int> DrawFolds(std::size_t poses, int folds, std::uint64_t seed);

// fit: base and tool from part of the observations.
HeldOutError CrossValidate(const Observations& observations,
                           const std::vector<int>& fold_of_pose,
                           const std::function<MethodFit(const Observations&)>& fit);

}  // namespace hexcal
