// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "measurement/dataset.h"
#include "residuals/pose_error.h"

namespace hexcal {

// A calibration by two rigid bodies of four markers under a moving tracker, 0.1 mm a coordinate.
struct MarkerStudy {
  BaseAndTool truth;
  Dataset dataset;  // without readings
};
MarkerStudy MakeMarkerStudy(int poses, std::uint64_t seed);

// The readings of draw number draw, each marker unseen with this probability. sigma_is_stated: by
// the dataset, else left to be estimated.
Dataset DrawMarkers(const MarkerStudy& study,
                    std::uint64_t draw,
                    bool sigma_is_stated,
                    double unseen);

}  // namespace hexcal
