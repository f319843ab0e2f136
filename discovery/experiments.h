// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "model/effect.h"

namespace hexcal {

// What cannot be told from an effect by any pose, as its law says and no number is needed for.
struct Gauge {
  struct Part {
    std::string name;      // of the table
    bool is_each = false;  // each leg its own, else all alike
  };
  std::string rival;
  std::vector<Part> together;  // are the rival; empty: it is none of the table
};

// The exact gauges of an effect under what the dataset measures. In measured poses a tracker that
// scales is a hexapod whose plates and legs are all larger; without base markers in every pose a
// base that moves is a tracker that moves; all markers of a body moved alike are the body moved.
std::vector<Gauge> GaugesOf(const Effect& effect, const Dataset& dataset);

// What experiment tells an effect from a rival where poses do not, one sentence without a stop.
std::string ExperimentFor(const std::string& effect, const std::string& rival);

}  // namespace hexcal
