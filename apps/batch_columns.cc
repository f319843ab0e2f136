// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// base.dx as base_dx.
std::string ColumnName(std::string_view start, std::string_view parameter) {
  std::string name = std::string(start) + std::string(parameter);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

void AddReals(std::vector<Column>* columns, const std::vector<std::string>& names) {
  for (const std::string& name : names) columns->push_back({name, CellKind::kReal});
}

void AddPose(std::vector<Cell>* cells, const Pose3d& pose) {
  for (const double x : pose.translation) cells->emplace_back(x);
  const Eigen::Quaterniond& q = pose.rotation;
  for (const double x : {q.w(), q.x(), q.y(), q.z()}) cells->emplace_back(x);
}

std::int64_t Size(std::size_t size) { return static_cast<std::int64_t>(size); }

std::string NameOfEffect(const DiscoveredEffect& found) {
  return found.labels.empty()
             ? found.effect.name
             : fmt::format("{} ({})", found.effect.name, fmt::join(found.labels, " "));
}

}  // namespace

const std::vector<Column>& CalibrationColumns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {{"dataset", CellKind::kText},
                               {"name", CellKind::kText},
                               {"poses", CellKind::kInteger},
                               {"warnings", CellKind::kInteger},
                               {"outliers", CellKind::kInteger}};
    for (const char* body : {"base", "tool"})
      for (const char* part : {"x", "y", "z", "qw", "qx", "qy", "qz"})
        AddReals(&all, {fmt::format("{}_{}", body, part)});
    for (const ParameterInfo& p : kParameters) AddReals(&all, {ColumnName("sd_", p.name)});
    AddReals(&all,
             {"noise_position",
              "noise_orientation",
              "noise_scale",
              "rmspe",
              "rmsoe",
              "chi_square",
              "degrees_of_freedom",
              "condition_number"});
    return all;
  }();
  return columns;
}

std::vector<Cell> CalibrationCells(const Dataset& dataset, const Estimate& estimate) {
  std::vector<Cell> cells = {dataset.name,
                             Size(estimate.poses.size()),
                             Size(estimate.warnings.size()),
                             Size(estimate.outliers.size())};
  AddPose(&cells, estimate.mounts.world_from_base);
  AddPose(&cells, estimate.mounts.platform_from_tool);
  for (int i = 0; i < 12; ++i)
    cells.emplace_back(estimate.observability.determined[i] ? std::sqrt(estimate.covariance(i, i))
                                                            : kNone);
  for (const double x : {estimate.noise.position,
                         estimate.noise.orientation,
                         estimate.noise_scale,
                         estimate.rmspe,
                         estimate.rmsoe,
                         estimate.chi_square,
                         static_cast<double>(estimate.degrees_of_freedom),
                         estimate.observability.condition_number})
    cells.emplace_back(x);
  return cells;
}

const std::vector<Column>& DiscoveryColumns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {{"dataset", CellKind::kText},
                               {"name", CellKind::kText},
                               {"poses", CellKind::kInteger},
                               {"verdict", CellKind::kText},
                               {"effects", CellKind::kText},
                               {"could_also_be", CellKind::kText}};
    AddReals(&all,
             {"p_value",
              "rms_position_before",
              "rms_position_after",
              "heldout_position_before",
              "heldout_position_after",
              "noise_floor_position"});
    return all;
  }();
  return columns;
}

std::vector<Cell> DiscoveryCells(const Dataset& dataset, const Discovery& discovery) {
  std::vector<std::string> effects, rivals;
  double p_value = kNone;  // the largest of those that were named
  for (const DiscoveredEffect& found : discovery.effects) {
    effects.push_back(NameOfEffect(found));
    for (const Rival& rival : found.could_also_be) rivals.push_back(rival.name);
    p_value = std::isnan(p_value) ? found.p_value : std::max(p_value, found.p_value);
  }
  const Gap& gap = discovery.gap;
  return {dataset.name,
          Size(discovery.poses.size()),
          std::string(NameOf(discovery.verdict)),
          fmt::format("{}", fmt::join(effects, "; ")),
          fmt::format("{}", fmt::join(rivals, "; ")),
          p_value,
          gap.before.rms_position,
          gap.after.rms_position,
          gap.heldout_before.rms_position,
          gap.heldout_after.rms_position,
          gap.noise_floor.rms_position};
}

std::string WhyUntrusted(const Estimate& estimate) {
  if (!estimate.converged) return "no convergence: " + estimate.message;
  return fmt::format("not determined: {}", fmt::join(estimate.observability.weak_directions, "; "));
}

}  // namespace hexcal
