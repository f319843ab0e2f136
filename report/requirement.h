// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "estimator/target_error.h"
#include "report/pivot_point.h"

namespace hexcal {

// A point of the tool, frame T, m.
struct NamedPoint {
  std::string name;
  Eigen::Vector3d p_in_tool = Eigen::Vector3d::Zero();
  double standard_deviation = 0.0;                 // of each coordinate, m; without pivot
  std::optional<PivotPoint> pivot = std::nullopt;  // by pivoting: its covariance is there

  ErrorSource Source() const;  // the error of the point itself
};

// What accuracy is asked for: the error of the point is not longer than limit with this
// probability, at every place.
struct Requirement {
  enum class Places { kWorkspace, kPoses };
  std::string name;
  std::size_t point = 0;  // index into Requirements::points
  Places over = Places::kWorkspace;
  double limit = 0.0;  // m
  double probability = 0.95;
};

// A row of the uncertainty budget that the user states.
struct StatedSource {
  ErrorSource source;
  std::string origin;  // where its value is from, in words
};

// A requirement file (docs/audit.md), SI.
struct Requirements {
  std::string path;
  std::vector<std::pair<std::string, std::string>> identification;  // free text
  std::vector<NamedPoint> points;
  // Ranges of T_A^B's six numbers of Eq. (2), m and rad; default: those of the dataset's poses.
  std::optional<std::array<std::array<double, 2>, 6>> workspace;
  std::optional<StatedSource> robot;  // of the pose that the robot reports; default: the dataset's
  std::vector<StatedSource> sources;
  std::vector<Requirement> requirements;
};

// InputError with file, line and column for whatever is not as docs/audit.md says.
Requirements ReadRequirements(const std::string& path);

}  // namespace hexcal
