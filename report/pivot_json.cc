// SPDX-License-Identifier: BSD-3-Clause
#include "report/pivot_json.h"

#include <cmath>

#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kParameterNames[6] = {
    "tip.x", "tip.y", "tip.z", "pivot.x", "pivot.y", "pivot.z"};

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// Of the pivot nothing is known along what the tip is not known along.
bool IsDetermined(const PivotResult& result, int parameter) {
  return parameter < 3 ? result.IsDetermined(parameter) : result.lost_count() == 0;
}

template <typename Value>
Json Determined(const PivotResult& result, int first, const Value& value) {
  Json list = Json::array();
  for (int k = first; k < first + 3; ++k)
    list.push_back(IsDetermined(result, k) ? Number(value(k)) : Json());
  return list;
}

Json Covariance(const PivotResult& result, int first, int size) {
  Json rows = Json::array();
  for (int i = first; i < first + size; ++i) {
    Json row = Json::array();
    for (int j = first; j < first + size; ++j)
      row.push_back(IsDetermined(result, i) && IsDetermined(result, j)
                        ? Json(result.covariance(i, j))
                        : Json());
    rows.push_back(row);
  }
  return rows;
}

Json PointObject(const PivotResult& result, const Eigen::Vector3d& p, int first) {
  return {{"xyz", JsonList(p)},
          {"standard_deviation",
           Determined(result, first, [&](int k) { return std::sqrt(result.covariance(k, k)); })},
          {"half_width_95", Determined(result, first, [&](int k) { return result.half_width[k]; })},
          {"degrees_of_freedom",
           Determined(result, first, [&](int k) { return result.degrees_of_freedom[k]; })},
          {"covariance", Covariance(result, first, 3)}};
}

Json NoiseObject(const PivotResult& result) {
  switch (result.noise) {
    case PivotNoise::kKnown:
      return {{"from", "stated"}};
    case PivotNoise::kUpToScale:
      return {{"from", "estimated"}, {"marker", result.noise_scale}};
    case PivotNoise::kUnknown:
      break;
  }
  return {{"from", "estimated"},
          {"position", result.position_noise},
          {"orientation", result.orientation_noise}};
}

Json Tilted(const PivotResult& result) {
  Json list = Json::array();
  for (int k = 0; k < 3; ++k)
    list.push_back({{"direction", JsonList(result.tilts.directions.col(k))},
                    {"rms", result.tilts.rms[k]},
                    {"noise", result.noise_tilts[k]},
                    {"determined", !result.is_lost[k]}});
  return list;
}

// What frame T is, where that is known.
Json ToolObject(const Measurement& measurement) {
  if (measurement.kind != Measurement::Kind::kMarkers) return {};
  const MarkerBody& body = measurement.bodies[static_cast<int>(BodyId::kTool)];
  if (body.is_centroid)
    return {{"markers", body.markers}, {"xyz", Json()}, {"x_axis", body.x_axis}};
  Json points = Json::array();
  for (Eigen::Index i = 0; i < body.p_in_body.cols(); ++i)
    points.push_back(JsonList(body.p_in_body.col(i)));
  return {{"markers", body.markers}, {"xyz", points}};
}

Json PivotObject(const Dataset& dataset, const PivotResult& result) {
  Json json;
  json["format"] = "hexcal/pivot/1";
  json["dataset"] = dataset.name;
  json["tool"] = ToolObject(*dataset.measurement);
  json["converged"] = result.converged;
  json["trustworthy"] = result.IsTrustworthy();
  json["tip"] = PointObject(result, result.x.tip_in_tool, 0);
  json["tip"]["degrees_of_freedom_together"] = Number(result.tip_degrees_of_freedom);
  json["tip"]["region_95"] = Number(result.tip_ellipsoid);
  json["pivot"] = PointObject(result, result.x.pivot_in_world, 3);
  json["parameters"] = kParameterNames;
  json["covariance"] = Covariance(result, 0, 6);
  json["noise"] = NoiseObject(result);
  json["rms"] = result.rms;
  json["chi_square"] = {{"value", result.chi_square},
                        {"degrees_of_freedom", result.degrees_of_freedom_of_fit},
                        {"low", result.chi_square_low},
                        {"high", result.chi_square_high},
                        {"is_a_test", result.IsTested()}};
  json["condition_number"] = Number(result.condition_number);
  json["tilts"] = Tilted(result);
  json["poses"] = Json::array();
  for (const PivotRow& row : result.rows)
    json["poses"].push_back({{"pose", row.label},
                             {"line", row.line > 0 ? Json(row.line) : Json()},
                             {"used", row.used},
                             {"residual", JsonList(row.residual)},
                             {"squared_sigmas", row.squared_sigmas}});
  json["outliers"] = Json::array();
  for (const PivotOutlier& outlier : result.outliers)
    json["outliers"].push_back({{"pose", result.rows[outlier.index].label},
                                {"line", result.rows[outlier.index].line},
                                {"distance", outlier.distance},
                                {"sigmas", outlier.sigmas},
                                {"p_value", outlier.p_value}});
  json["warnings"] = result.warnings;
  return json;
}

}  // namespace

std::string PivotJson(const Dataset& dataset, const PivotResult& result) {
  return JsonText(PivotObject(dataset, result));
}

std::string PivotJsonLine(const Dataset& dataset, const PivotResult& result) {
  return JsonLine(PivotObject(dataset, result));
}

}  // namespace hexcal
