// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_json_parts.h"

#include <cmath>

#include "report/json_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json Twelve(const Vector12d& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(JsonNumber(value));
  return list;
}

Json Ranges(const std::array<std::array<double, 2>, 6>& ranges) {
  Json list = Json::array();
  for (const auto& range : ranges) list.push_back({range[0], range[1]});
  return list;
}

}  // namespace

Json JsonNumber(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json JsonFit(const ResultHeader& header) {
  Json fit = {{"solver", header.solver}, {"residual", header.residual}};
  if (!header.error.empty()) fit["error"] = header.error;
  fit["loss"] = std::string(NameOf(header.loss.kind));
  if (header.loss.kind != LossKind::kNone) fit["loss_scale"] = header.loss.scale;
  fit["covariance"] = header.is_sandwich ? "sandwich" : "model";
  return fit;
}

Json JsonCoverage(const Coverage& coverage) {
  return {{"inside", coverage.inside},
          {"of", coverage.of},
          {"nominal", coverage.nominal},
          {"low", coverage.limits.low},
          {"high", coverage.limits.high}};
}

Json JsonRows(const Audit& audit) {
  Json list = Json::array();
  for (const RowCount& count : audit.rows) {
    Json reasons = Json::object();
    for (const auto& [code, number] : count.reasons) reasons[code] = number;
    list.push_back({{"input", count.input},
                    {"given", count.given},
                    {"used", count.used},
                    {"missing", count.missing},
                    {"rejected", count.rejected},
                    {"reasons", reasons}});
  }
  return list;
}

Json JsonPoseDesign(const PoseDesign& design) {
  Json axes = Json::array();
  for (int k = 0; k < 3; ++k) axes.push_back(JsonList(design.main_axes.col(k)));
  return {{"ranges", Ranges(design.span)},
          {"legs", design.legs.empty() ? Json() : Ranges(design.leg_span)},
          {"leg_limits",
           design.leg_limits ? Json({(*design.leg_limits)[0], (*design.leg_limits)[1]}) : Json()},
          {"rotation_rms", JsonList(design.rotation_rms)},
          {"rotation_axes", axes},
          {"angle_between_axes", design.angle_between_axes}};
}

Json JsonLinearity(const Audit& audit) {
  Json solutions = Json::array(), repeated = Json::array();
  for (const LinearizedSolution& solution : audit.linearity.solutions) {
    Json points = Json::array();
    for (std::size_t p = 0; p < solution.points.size(); ++p)
      points.push_back({{"point", audit.requirements.points[p].name},
                        {"centre", JsonNumber(solution.points[p].centre)},
                        {"largest", JsonNumber(solution.points[p].largest)},
                        {"rms_ratio", JsonNumber(solution.points[p].ratio)}});
    solutions.push_back({{"name", solution.name},
                         {"converged", solution.estimate.converged},
                         {"difference", Twelve(solution.over_u)},
                         {"uncertainty_ratio", Twelve(solution.ratio)},
                         {"points", points}});
  }
  for (std::size_t i = 0; i < audit.linearity.repeated.size(); ++i)
    repeated.push_back({{"parameter", std::string(kParameters[i].name)},
                        {"uncertainty_ratio", JsonNumber(audit.linearity.repeated[i].ratio)},
                        {"coverage", JsonCoverage(audit.linearity.repeated[i].coverage)}});
  return {{"solutions", solutions}, {"repeated", repeated}};
}

Json JsonChange(const Audit& audit) {
  const Change& change = *audit.change;
  Json points = Json::array();
  for (std::size_t i = 0; i < change.at_points.size(); ++i)
    points.push_back(
        {{"point", audit.requirements.points[i].name}, {"moved", change.at_points[i]}});
  const SharedReadings& shared = change.shared;
  return {{"dataset", change.earlier.dataset},
          {"difference", JsonList(change.difference)},
          {"sigmas", Twelve(change.sigmas)},
          {"chi_square", JsonNumber(change.chi_square)},
          {"p_value", JsonNumber(change.p_value)},
          {"points", points},
          {"shared_readings",
           {{"known", shared.is_known},
            {"poses", shared.poses},
            {"of", shared.of},
            {"earlier_of", shared.earlier_of}}},
          {"over_own", Twelve(change.over_own)}};
}

Json JsonBudget(const Budget& budget) {
  Json list = Json::array();
  for (const BudgetRow& row : budget.rows)
    list.push_back({{"source", row.name},
                    {"from", row.origin},
                    {"type", std::string(1, row.type)},
                    {"quantity", std::string(NameOf(row.quantity))},
                    {"value", JsonNumber(row.value)},
                    {"distribution", std::string(NameOf(row.spread))},
                    {"divisor", row.divisor},
                    {"sensitivity", JsonNumber(row.sensitivity)},
                    {"rms", JsonNumber(row.contribution)},
                    {"share", JsonNumber(row.share)},
                    {"degrees_of_freedom", JsonNumber(row.degrees_of_freedom)}});
  return list;
}

Json JsonParameters(const Budget& budget) {
  Json list = Json::array();
  for (const ParameterRow& row : budget.parameters)
    list.push_back({{"parameter", row.name},
                    {"unit", row.unit},
                    {"standard_uncertainty", JsonNumber(row.value)},
                    {"sensitivity", JsonNumber(row.sensitivity)},
                    {"rms", JsonNumber(row.contribution)},
                    {"share", JsonNumber(row.share)},
                    {"degrees_of_freedom", JsonNumber(row.degrees_of_freedom)}});
  return {{"parameters", list}, {"correlations", JsonNumber(budget.correlations)}};
}

Json JsonValidation(const PointValidation& validation) {
  Json repeated;
  if (const auto& r = validation.repeated)
    repeated = {{"poses", r->poses},
                {"fewest_visits", r->fewest},
                {"accuracy", JsonNumber(r->accuracy)},
                {"repeatability", JsonNumber(r->repeatability)}};
  return {{"poses", validation.poses},
          {"bias", JsonList(validation.bias)},
          {"bias_uncertainty", JsonList(validation.BiasUncertainty())},
          {"precision", JsonList(validation.precision)},
          {"rms", JsonNumber(validation.rms)},
          {"repeated", repeated}};
}

}  // namespace hexcal
