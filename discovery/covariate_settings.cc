// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/covariate_settings.h"

#include <algorithm>
#include <map>
#include <string>

namespace hexcal {
namespace {

constexpr std::size_t kFew = 5;

// Covariates of one group have one key.
std::string GroupOf(const std::string& name) {
  static const std::map<std::string, std::string> groups = {{"vx", "velocity"},
                                                            {"vy", "velocity"},
                                                            {"vz", "velocity"},
                                                            {"wx", "velocity"},
                                                            {"wy", "velocity"},
                                                            {"wz", "velocity"}};
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second;
  for (const char* prefix : {"payload", "direction_"})
    if (name.rfind(prefix, 0) == 0) return prefix;
  return name;
}

std::vector<std::vector<double>> RowsOf(const RobotPoses& poses, const std::vector<int>& columns) {
  std::vector<std::vector<double>> rows;
  for (std::size_t row = 0; row < poses.rows.size(); ++row) {
    rows.emplace_back();
    for (const int column : columns) rows.back().push_back(poses.covariates[column].values[row]);
  }
  return rows;
}

void Unique(std::vector<std::vector<double>>* rows) {
  std::sort(rows->begin(), rows->end());
  rows->erase(std::unique(rows->begin(), rows->end()), rows->end());
}

// Sorted rows: the extremes of each column, and the middle one.
std::vector<std::vector<double>> Spread(const std::vector<std::vector<double>>& rows) {
  std::vector<std::vector<double>> some = {rows[rows.size() / 2]};
  for (std::size_t column = 0; column < rows[0].size(); ++column) {
    const auto less = [column](const auto& a, const auto& b) { return a[column] < b[column]; };
    some.push_back(*std::min_element(rows.begin(), rows.end(), less));
    some.push_back(*std::max_element(rows.begin(), rows.end(), less));
  }
  Unique(&some);
  return some;
}

}  // namespace

std::vector<CovariateGroup> CovariateSettings(const Dataset& dataset,
                                              const ChosenSettings& chosen) {
  const RobotPoses& poses = dataset.robot_poses;
  std::vector<std::string> names;
  std::vector<CovariateGroup> groups;
  for (std::size_t column = 0; column < poses.covariates.size(); ++column) {
    if (poses.covariates[column].name == "time") continue;
    const std::string& own = poses.covariates[column].name;
    const std::string name = chosen.count(own) > 0 ? own + " alone" : GroupOf(own);
    const auto found = std::find(names.begin(), names.end(), name);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end()) names.push_back(name), groups.emplace_back();
    groups[at].columns.push_back(static_cast<int>(column));
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    CovariateGroup& group = groups[g];
    const auto set = chosen.find(poses.covariates[group.columns[0]].name);
    if (set != chosen.end()) {
      for (const double value : set->second) group.settings.push_back({value});
      continue;
    }
    group.settings = RowsOf(poses, group.columns);
    if (names[g] == "direction_")
      for (const double side : {-1.0, 1.0}) group.settings.emplace_back(group.columns.size(), side);
    Unique(&group.settings);
    if (group.settings.size() > kFew) group.settings = Spread(group.settings);
  }
  return groups;
}

}  // namespace hexcal
