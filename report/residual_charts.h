// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/html/page.h"
#include "report/pose_residuals.h"

namespace hexcal {

// Position, then orientation: each axis against the order of visit, and against time where that was
// recorded. With the table of their numbers; mm and mrad.
std::vector<Chart> ResidualCharts(const PoseResiduals& residuals);

// Those poses that are drawn of so many, and a sentence that says it where some are not.
struct DrawnPoses {
  explicit DrawnPoses(const std::vector<std::string>& labels);
  std::vector<bool> Of(const std::vector<bool>& all) const;
  std::vector<std::size_t> indices;
  nlohmann::ordered_json order = nlohmann::ordered_json::array();
  nlohmann::ordered_json labels = nlohmann::ordered_json::array();
  std::string note;
};

}  // namespace hexcal
