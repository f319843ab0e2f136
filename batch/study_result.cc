// SPDX-License-Identifier: BSD-3-Clause
#include "batch/study_result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/predict.h"

namespace hexcal {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string ColumnOf(std::string_view start, std::string_view parameter) {
  std::string name = fmt::format("{}_{}", start, parameter);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Vector12d ErrorOf(const BaseAndTool& mounts, const Machine& truth) {
  Vector12d error;
  error << Minus(mounts.world_from_base, truth.world_from_base),
      Minus(mounts.platform_from_tool, truth.platform_from_tool);
  return error;
}

// d' C^-1 d; NaN where C is singular.
double SquaredDistance(const Vector12d& d, const Matrix12d& covariance) {
  const Vector12d sigma = covariance.diagonal().cwiseSqrt();
  if (!(sigma.minCoeff() > 0.0)) return kNone;
  const Vector12d scaled = d.cwiseQuotient(sigma);
  const Matrix12d correlation =
      sigma.cwiseInverse().asDiagonal() * covariance * sigma.cwiseInverse().asDiagonal();
  const Eigen::LLT<Matrix12d> factor(correlation);
  return factor.info() == Eigen::Success ? scaled.dot(factor.solve(scaled)) : kNone;
}

struct Rms {
  double position = kNone, orientation = kNone;
};

template <typename Pairs>
Rms RmsOf(const Pairs& pairs, std::size_t count) {
  if (count == 0) return {};
  double position = 0.0, orientation = 0.0;
  pairs([&](const Pose3d& predicted, const Pose3d& other) {
    const Vector6d d = Minus(other, predicted);
    position += d.head<3>().squaredNorm();
    orientation += d.tail<3>().squaredNorm();
  });
  return {std::sqrt(position / count), std::sqrt(orientation / count)};
}

std::vector<Pose3d> PredictedTools(const StudyCell& cell, const StudyResult& result) {
  if (result.discovery) return Predict(result.discovery->machine, cell.test);
  std::vector<Pose3d> predicted;
  for (const Pose3d& base_from_platform : cell.test_reported)
    predicted.push_back(result.mounts.world_from_base * base_from_platform *
                        result.mounts.platform_from_tool);
  return predicted;
}

void AddAccuracy(const StudyCell& cell, const StudyResult& result, std::vector<Cell>* cells) {
  const std::vector<Pose3d> predicted = PredictedTools(cell, result);
  const Rms to_true = RmsOf(
      [&](const auto& use) {
        for (std::size_t i = 0; i < predicted.size(); ++i) use(predicted[i], cell.test_true[i]);
      },
      predicted.size());
  const Rms to_measured = RmsOf(
      [&](const auto& use) {
        for (const auto& [row, measured] : cell.test_measured) use(predicted[row], measured);
      },
      cell.test_measured.size());
  for (const double x : {to_true.position, to_true.orientation, to_measured.position})
    cells->emplace_back(x);
}

void AddParameters(const StudyCell& cell, const StudyResult& result, std::vector<Cell>* cells) {
  const Vector12d error = ErrorOf(result.mounts, cell.truth);
  for (const double x : error) cells->emplace_back(x);
  if (!result.estimate) {
    cells->resize(cells->size() + 14);
    return;
  }
  const Intervals& intervals = result.estimate->intervals;
  const auto& determined = result.estimate->observability.determined;
  for (int i = 0; i < 12; ++i) cells->emplace_back(determined[i] ? intervals.half_width[i] : kNone);
  cells->emplace_back(SquaredDistance(error, result.estimate->covariance));
  cells->emplace_back(intervals.ellipsoid);
}

void AddFit(const StudyResult& result, std::vector<Cell>* cells) {
  if (!result.estimate) {
    cells->resize(cells->size() + 6);
    return;
  }
  const Estimate& e = *result.estimate;
  for (const double x : {e.rmspe,
                         e.rmsoe,
                         e.chi_square,
                         static_cast<double>(e.degrees_of_freedom),
                         e.noise.position,
                         e.noise.orientation})
    cells->emplace_back(x);
}

void AddDetection(const StudyCell& cell, const StudyResult& result, std::vector<Cell>* cells) {
  if (!result.discovery) {
    cells->resize(cells->size() + 5);
    return;
  }
  const Detection detection = DetectionOf(cell.truth, *result.discovery);
  std::vector<std::string> names;
  for (const DiscoveredEffect& found : result.discovery->effects)
    names.push_back(found.effect.name);
  cells->emplace_back(std::string(NameOf(result.discovery->verdict)));
  cells->emplace_back(fmt::format("{}", fmt::join(names, "; ")));
  for (const int n : {detection.hidden, detection.named, detection.false_names})
    cells->emplace_back(std::int64_t{n});
}

}  // namespace

std::vector<Column> StudyColumns(int records) {
  std::vector<Column> all = {{"scenario", CellKind::kText},
                             {"noise", CellKind::kReal},
                             {"poses", CellKind::kInteger},
                             {"effects", CellKind::kReal},
                             {"draw", CellKind::kInteger},
                             {"estimator", CellKind::kText},
                             {"converged", CellKind::kInteger},
                             {"iterations", CellKind::kInteger}};
  const auto add = [&all](const std::string& name) { all.push_back({name, CellKind::kReal}); };
  for (const char* name : {"rms_position", "rms_orientation", "rms_position_measured"}) add(name);
  for (const ParameterInfo& p : kParameters) add(ColumnOf("error", p.name));
  for (const ParameterInfo& p : kParameters) add(ColumnOf("half_width", p.name));
  for (const char* name : {"squared_distance",
                           "ellipsoid",
                           "rmspe",
                           "rmsoe",
                           "chi_square",
                           "degrees_of_freedom",
                           "noise_position",
                           "noise_orientation"})
    add(name);
  for (const char* name : {"verdict", "effects_found"}) all.push_back({name, CellKind::kText});
  for (const char* name : {"hidden", "named", "false_names"})
    all.push_back({name, CellKind::kInteger});
  for (int i = 0; i < records; ++i) add(fmt::format("rmspe_{}", i));
  return all;
}

std::vector<Cell> StudyCells(const Study& study,
                             std::int64_t task,
                             const StudyEstimator& estimator,
                             const StudyResult& result) {
  const std::int64_t count = static_cast<std::int64_t>(study.cells.size());
  const StudyCell& cell = study.cells[static_cast<std::size_t>(task % count)];
  const std::int64_t steps =
      std::max<std::int64_t>(0, static_cast<std::int64_t>(result.iterations.size()) - 1);
  std::vector<Cell> cells = {cell.scenario,
                             cell.noise,
                             std::int64_t{cell.PosesADraw()},
                             cell.effects,
                             task / count,
                             estimator.name,
                             std::int64_t{result.converged ? 1 : 0},
                             result.iterations.empty() ? Cell() : Cell(steps)};
  AddAccuracy(cell, result, &cells);
  AddParameters(cell, result, &cells);
  AddFit(result, &cells);
  AddDetection(cell, result, &cells);
  for (int i = 0; i < study.records; ++i) {
    const auto at = static_cast<std::size_t>(i);
    cells.emplace_back(at < result.iterations.size() ? result.iterations[at].rmspe : kNone);
  }
  return cells;
}

Detection DetectionOf(const Machine& truth, const Discovery& discovery) {
  std::set<std::string> hidden, found;
  for (const Effect& effect : truth.effects) hidden.insert(effect.name);
  Detection detection;
  detection.hidden = static_cast<int>(hidden.size());
  for (const DiscoveredEffect& effect : discovery.effects) {
    std::set<std::string> names = {effect.effect.name};
    for (const Rival& rival : effect.could_also_be) names.insert(rival.name);
    const bool is_true = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return hidden.count(name) > 0;
    });
    if (!is_true) ++detection.false_names;
    found.insert(names.begin(), names.end());
  }
  for (const std::string& name : hidden) detection.named += found.count(name) > 0 ? 1 : 0;
  return detection;
}

}  // namespace hexcal
