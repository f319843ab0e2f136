// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "discovery/discovery.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

struct DiscoverOptions {
  double alpha = 0.01;   // chance of a name for data that need none
  int bootstraps = 999;  // draws for the family-wise p-value; at least 99
  int folds = 5;         // of the held-out test; below 2: not done
  int most_effects = 4;
  std::optional<NoiseLevels> noise = {};  // in place of one that is not stated
  std::uint64_t seed = 1;
  int threads = 1;
  // To start from: its effects are fitted along with base and tool, what is beyond them is sought.
  // No pose map.
  std::optional<Machine> model = {};
  // Called with what is done and how much there is to do, and the name of the stage.
  std::function<void(const char* stage, int done, int of)> progress;
};

// The whole chain (docs/discovery.md). InputError where the dataset cannot be calibrated.
Discovery Discover(const Dataset& dataset, const DiscoverOptions& options);

}  // namespace hexcal
