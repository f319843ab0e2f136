// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "measurement/dataset.h"

namespace hexcal {

// A tool tip from pivot.json, frame T, m.
struct PivotPoint {
  std::string path;
  Eigen::Vector3d p_in_tool = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double degrees_of_freedom = std::numeric_limits<double>::infinity();  // of the covariance
  // The markers that frame T was made of, where the pivoting was of markers.
  std::optional<MarkerBody> tool;
  // Why nothing may rest on the tip, as a part of a sentence each, by its chi-square and outliers.
  // Empty, too, where its file is of a version that did not say it.
  std::vector<std::string> doubts;
  Location where;  // of the name in the requirement file
};

// The pivot.json that a file at context_path names; it must lie in that file's folder. InputError
// where it is none of hexcal's, and where the tip is not determined.
PivotPoint ReadPivotPoint(const YamlNode& path, const std::string& context_path);

// InputError where both know the markers of the tool and they are not the same: the tip is in
// another frame then.
void RequireSameTool(const PivotPoint& point, const Dataset& dataset);

}  // namespace hexcal
