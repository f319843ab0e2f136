// SPDX-License-Identifier: BSD-3-Clause
#include "report/result_json.h"

#include <cmath>

#include "report/effect_json.h"
#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json CovarianceRows(const Matrix12d& covariance, const Observability& observability) {
  Json rows = Json::array();
  for (int i = 0; i < 12; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 12; ++j)
      row.push_back(observability.determined[i] && observability.determined[j]
                        ? Json(covariance(i, j))
                        : Json());
    rows.push_back(row);
  }
  return rows;
}

// null: not determined, or infinite.
Json Determined(const Vector12d& values, const Observability& observability) {
  Json list = Json::array();
  for (int i = 0; i < 12; ++i)
    list.push_back(observability.determined[i] && std::isfinite(values[i]) ? Json(values[i])
                                                                           : Json());
  return list;
}

Matrix12d Correlation(const Matrix12d& covariance) {
  const Vector12d scale =
      covariance.diagonal().unaryExpr([](double v) { return v > 0 ? 1.0 / std::sqrt(v) : 0.0; });
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

// Poses stand in the order of the dataset's.
Json Poses(const Estimate& estimate, const DatasetReadings& readings) {
  Json list = Json::array();
  auto row = readings.begin();
  for (const PoseResult& p : estimate.poses) {
    Json pose = {{"pose", p.label}, {"weight", p.weight}, {"residual", JsonList(p.residual)}};
    while (row != readings.end() && row->pose != p.label) ++row;
    if (row != readings.end()) pose["readings"] = HexOf(row->hash);
    for (const MarkerMisfit& m : p.markers)
      pose["markers"].push_back({{"marker", m.marker}, {"residual", JsonList(m.residual)}});
    list.push_back(std::move(pose));
  }
  return list;
}

Json Outliers(const Estimate& estimate) {
  Json list = Json::array();
  for (const Outlier& o : estimate.outliers)
    list.push_back({{"pose", o.label},
                    {"reason", o.reason},
                    {"statistic", o.statistic},
                    {"p_value", o.p_value},
                    {"position_sigmas", o.position_sigmas},
                    {"orientation_sigmas", o.orientation_sigmas},
                    {"residual", JsonList(o.residual)}});
  return list;
}

Json Noise(const NoiseSummary& noise) {
  Json object = {{"position", noise.position},
                 {"orientation", noise.orientation},
                 {"estimated", noise.estimated},
                 {"assumed", std::string(NameOf(noise.assumed))}};
  if (noise.marker) object["marker"] = JsonList(*noise.marker);
  return object;
}

Json ResultObject(const ResultHeader& header,
                  const Estimate& estimate,
                  const std::vector<Effect>& effects) {
  const Observability& observability = estimate.observability;
  Json result;
  result["format"] = "hexcal/result/1";
  result["dataset"] = header.dataset;
  result["solver"] = header.solver;
  result["residual"] = header.residual;
  if (!header.error.empty()) result["error"] = header.error;
  if (header.loss.kind != LossKind::kNone)
    result["loss"] = {{"kind", std::string(NameOf(header.loss.kind))},
                      {"scale", header.loss.scale}};
  result["converged"] = estimate.converged;
  result["world_from_base"] = JsonPose(estimate.mounts.world_from_base);
  result["platform_from_tool"] = JsonPose(estimate.mounts.platform_from_tool);
  result["parameters"] = JsonParameterNames();
  result["covariance"] = CovarianceRows(estimate.covariance, observability);
  result["standard_deviation"] = JsonStandardDeviations(estimate.covariance, observability);
  result["correlation"] = CovarianceRows(Correlation(estimate.covariance), observability);
  result["covariance_unscaled"] = CovarianceRows(estimate.covariance_unscaled, observability);
  result["standard_deviation_unscaled"] =
      JsonStandardDeviations(estimate.covariance_unscaled, observability);
  result["half_width_95"] = Determined(estimate.intervals.half_width, observability);
  result["effective_degrees_of_freedom"] =
      Determined(estimate.intervals.degrees_of_freedom, observability);
  result["ellipsoid_95"] = estimate.intervals.ellipsoid;
  result["noise"] = Noise(estimate.noise);
  result["noise_scale"] = estimate.noise_scale;
  result["rmspe"] = estimate.rmspe;
  result["rmsoe"] = estimate.rmsoe;
  result["chi_square"] = estimate.chi_square;
  result["degrees_of_freedom"] = estimate.degrees_of_freedom;
  if (estimate.least_squares)
    result["least_squares"] = {{"chi_square", estimate.least_squares->chi_square},
                               {"degrees_of_freedom", estimate.least_squares->degrees_of_freedom},
                               {"noise_scale", estimate.least_squares->Scale()}};
  result["iterations"] = JsonIterations(estimate.iterations);
  result["observability"] = {{"singular_values", JsonList(observability.singular_values)},
                             {"condition_number", observability.condition_number},
                             {"weak_directions", observability.weak_directions}};
  result["certificate"] = estimate.certificate ? JsonCertificate(*estimate.certificate) : Json();
  result["poses"] = Poses(estimate, header.readings);
  result["outliers"] = Outliers(estimate);
  result["effects"] = Json::array();
  for (const Effect& effect : effects) result["effects"].push_back(JsonEffect(effect));
  result["warnings"] = estimate.warnings;
  return result;
}

}  // namespace

std::string ResultJson(const ResultHeader& header,
                       const Estimate& estimate,
                       const std::vector<Effect>& effects) {
  return JsonText(ResultObject(header, estimate, effects));
}

std::string ResultJsonLine(const ResultHeader& header,
                           const Estimate& estimate,
                           const std::vector<Effect>& effects) {
  return JsonLine(ResultObject(header, estimate, effects));
}

}  // namespace hexcal
