// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_json.h"

#include "geometry/rotation_angles.h"
#include "report/audit_json_parts.h"
#include "report/audit_model.h"
#include "report/json_parts.h"
#include "report/json_text.h"
#include "report/missing_effects.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json PlaceObject(const Place& place) {
  Json object = {{"pose_vector", JsonList(VectorFromPose(place.base_from_platform))}};
  if (!place.label.empty()) object["pose"] = place.label;
  return object;
}

Json Decisions(const Audit& audit) {
  Json list = Json::array();
  for (const Decision& d : audit.decisions)
    list.push_back(
        {{"name", d.requirement.name},
         {"verdict", std::string(NameOf(d.compliance))},
         {"point", audit.requirements.points[d.requirement.point].name},
         {"over", d.requirement.over == Requirement::Places::kPoses ? "poses" : "workspace"},
         {"limit", d.requirement.limit},
         {"probability", d.requirement.probability},
         {"value", d.value > 0.0 ? Json(d.value) : Json()},
         {"guard_band", d.value > 0.0 ? Json(d.guard) : Json()},
         {"worst", d.value > 0.0 ? PlaceObject(d.worst) : Json()},
         {"reason", d.reason}});
  return list;
}

Json AtObject(const PointAt& at) {
  Json object = PlaceObject(at.place);
  object["rms"] = at.rms;
  object["length_95"] = at.length_95;
  return object;
}

Json CheckObject(const TargetCheck& check) {
  return {{"draws", check.draws},
          {"rms", check.rms},
          {"repeated_rms", check.repeated_rms},
          {"length_95", check.quantile},
          {"repeated_length_95", check.repeated_quantile},
          {"standard_error", check.standard_error},
          {"tolerance", check.tolerance},
          {"coverage", JsonCoverage(CoverageOf(check.inside, check.draws, 0.95))},
          {"stated_coverage", JsonCoverage(CoverageOf(check.inside_stated, check.draws, 0.95))},
          {"agrees", check.agrees}};
}

// One for all coordinates, or of a pivoting one each.
Json Deviations(const NamedPoint& point) {
  if (!point.pivot) return point.standard_deviation;
  return JsonList(point.pivot->covariance.diagonal().cwiseSqrt().eval());
}

Json PivotOf(const NamedPoint& point) {
  if (!point.pivot) return {};
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back(JsonList(point.pivot->covariance.row(i)));
  return {{"file", point.pivot->path},
          {"covariance", rows},
          {"degrees_of_freedom", JsonNumber(point.pivot->degrees_of_freedom)}};
}

Json Points(const Audit& audit) {
  Json list = Json::array();
  for (const PointReport& report : audit.points) {
    list.push_back({{"name", report.point.name},
                    {"xyz", JsonList(report.point.p_in_tool)},
                    {"standard_deviation", Deviations(report.point)},
                    {"pivot", PivotOf(report.point)},
                    {"centre", AtObject(report.centre)},
                    {"worst", AtObject(report.worst)},
                    {"budget", JsonBudget(report.budget)},
                    {"calibration", JsonParameters(report.budget)},
                    {"held_out", JsonValidation(report.validation)},
                    {"monte_carlo", report.check ? CheckObject(*report.check) : Json()}});
  }
  return list;
}

Json Poses(const Audit& audit) {
  Json list = Json::array();
  for (const PoseCheck& pose : audit.poses)
    list.push_back({{"pose", pose.label},
                    {"held_out", JsonList(pose.held_out)},
                    {"squared_sigmas", pose.squared},
                    {"smallest_position", pose.smallest_position},
                    {"smallest_orientation", pose.smallest_orientation},
                    {"redundancy", pose.redundancy}});
  return list;
}

Json Methods(const Audit& audit) {
  Json list = Json::array();
  for (const MethodResult& method : audit.comparison.methods) {
    Json sigmas = Json::array();
    for (const double s : method.sigmas) sigmas.push_back(JsonNumber(s));
    list.push_back(
        {{"name", std::string(InfoOf(method.method).name)},
         {"converged", method.fit.converged},
         {"difference", sigmas},
         {"held_out_position", method.held_out ? Json(method.held_out->position) : Json()},
         {"held_out_orientation", method.held_out ? Json(method.held_out->orientation) : Json()}});
  }
  return list;
}

Json Bodies(const Audit& audit) {
  Json list = Json::array();
  for (const BodyReport& body : audit.bodies)
    list.push_back({{"body", body.name},
                    {"markers", body.markers},
                    {"sigma", body.sigma},
                    {"fiducial_registration_error", body.fiducial},
                    {"target_registration_error", body.at_points}});
  return list;
}

Json AuditObject(const AuditIdentity& identity, const Audit& audit) {
  Json json;
  json["format"] = "hexcal/audit/1";
  json["dataset"] = audit.header.dataset;
  json["id"] = identity.id;
  json["fit"] = JsonFit(audit.header);
  json["verdict"] = std::string(NameOf(audit.compliance));
  json["requirements"] = Decisions(audit);
  json["doubts"] = audit.doubts;
  json["identification"] = Json::object();
  for (const auto& [key, value] : audit.requirements.identification)
    json["identification"][key] = value;
  json["inputs"] = Json::array();
  for (const HashedFile& file : identity.inputs)
    json["inputs"].push_back({{"file", file.path}, {"sha256", file.sha256}});
  json["rows"] = JsonRows(audit);
  Json box = Json::array();
  for (const auto& range : audit.workspace.box) box.push_back({range[0], range[1]});
  json["workspace"] = {{"ranges", box},
                       {"stated", audit.workspace.is_stated},
                       {"measured", audit.workspace.IsMeasured()},
                       {"places", audit.places}};
  json["pose_design"] = JsonPoseDesign(audit.design);
  json["points"] = Points(audit);
  json["strong_correlations"] = Json::array();
  for (const Correlation& c : audit.correlations)
    json["strong_correlations"].push_back({{"a", std::string(kParameters[c.a].name)},
                                           {"b", std::string(kParameters[c.b].name)},
                                           {"value", c.value}});
  json["global_test"] = {{"noise_is_stated", audit.global.is_stated},
                         {"only_rounding", audit.global.is_rounding},
                         {"tested", audit.global.is_of_fit ? "fit" : "least_squares"},
                         {"chi_square", audit.global.tested.chi_square},
                         {"degrees_of_freedom", audit.global.tested.degrees_of_freedom},
                         {"low", audit.global.low},
                         {"high", audit.global.high},
                         {"too_large", audit.global.is_too_large},
                         {"too_small", audit.global.is_too_small}};
  const HeldOutTest& held = audit.held_out;
  json["held_out"] = {{"rms_position", held.rms_position},
                      {"expected_position", held.expected_position},
                      {"rms_orientation", held.rms_orientation},
                      {"expected_orientation", held.expected_orientation},
                      {"inside_95", held.inside},
                      {"poses", held.poses},
                      {"fewest_inside", held.fewest},
                      {"coverage", held.coverage ? JsonCoverage(*held.coverage) : Json()}};
  json["missing_effects"] = JsonMissingEffects(audit);
  json["methods"] = Methods(audit);
  const PropagationCheck& propagation = audit.comparison.propagation;
  json["propagation"] = {{"done", propagation.done},
                         {"why_not", propagation.why_not},
                         {"repeated", propagation.done ? Json(audit.repeated.words) : Json()},
                         {"repeated_is_fit", propagation.done && audit.repeated.is_audits},
                         {"not_converged", propagation.not_converged},
                         {"draws", propagation.draws},
                         {"stable", propagation.stable},
                         {"validated", propagation.validated}};
  json["linearized"] = JsonLinearity(audit);
  json["bodies"] = Bodies(audit);
  json["poses"] = Poses(audit);
  json["readings"] = audit.readings ? JsonReadings(*audit.readings) : Json();
  json["change"] = audit.change ? JsonChange(audit) : Json();
  if (audit.grown) json["model"] = JsonModel(audit);
  if (identity.log) json["history"] = ChangeLogJson(*identity.log);
  json["warnings"] = audit.estimate.warnings;
  return json;
}

}  // namespace

std::string AuditJson(const AuditIdentity& identity, const Audit& audit) {
  return JsonText(AuditObject(identity, audit));
}

std::string AuditJsonLine(const AuditIdentity& identity, const Audit& audit) {
  return JsonLine(AuditObject(identity, audit));
}

}  // namespace hexcal
