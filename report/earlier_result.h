// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "residuals/pose_error.h"

namespace hexcal {

// What a result.json of an earlier run says of base and tool.
struct EarlierResult {
  std::string path, dataset;
  BaseAndTool mounts;
  Matrix12d covariance = Matrix12d::Zero();
  std::array<bool, 12> determined = {};
  // What its poses that had a weight were read by (report/readings.h); empty where it does not say.
  std::vector<std::string> readings = {};
};

// InputError for a file that is no result.json.
EarlierResult ReadEarlierResult(const std::string& path);

}  // namespace hexcal
