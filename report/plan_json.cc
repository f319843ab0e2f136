// SPDX-License-Identifier: BSD-3-Clause
#include "report/plan_json.h"

#include "report/json_parts.h"
#include "report/json_text.h"
#include "report/plan_words.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json PoseObject(const Plan& plan, std::size_t k) {
  const Pose3d& pose = plan.base_from_platform[k];
  Json object = {
      {"pose", plan.poses.rows[k].label},
      {"xyz", JsonList(pose.translation)},
      {"quaternion", {pose.rotation.w(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z()}}};
  if (plan.poses.are_leg_lengths) object["leg_lengths"] = plan.poses.rows[k].leg_lengths;
  Json covariates = Json::object();
  for (const Covariate& covariate : plan.poses.covariates)
    covariates[covariate.name] = covariate.values[k];
  object["covariates"] = covariates;
  object["why"] = ReasonText(plan, plan.reasons[k]);
  return object;
}

Json PairObject(const Plan& plan, const RivalPair& pair) {
  return {{"effect", pair.effect},
          {"index", pair.index},
          {"rival", pair.rival},
          {"size", {{"before", pair.size_before}, {"after", pair.size_after}}},
          {"distance",
           {{"before", pair.before}, {"after", pair.after}, {"whole_pool", pair.whole_pool}}},
          {"mistaken",
           {{"before", ChanceOfMistake(pair.before)}, {"after", ChanceOfMistake(pair.after)}}},
          {"separable", std::string(NameOf(pair.separation))},
          {"exactly_the_same", pair.is_exact},
          {"poses_needed", pair.poses_needed > 0 ? Json(pair.poses_needed) : Json()},
          {"experiment", pair.experiment},
          {"says", SeparationSentence(plan, pair)}};
}

Json PlanObject(const std::string& dataset, const PlanOptions& options, const Plan& plan) {
  Json object;
  object["format"] = "hexcal/plan/1";
  object["dataset"] = dataset;
  object["for"] = plan.goal == PlanGoal::kRivals ? "rivals" : "parameters";
  object["settings"] = {{"poses", options.poses},
                        {"pool", options.pool},
                        {"columns", options.settings},
                        {"seed", options.seed}};
  object["measured"] = plan.measured;
  object["pool"] = plan.pool;
  object["parameters"] = JsonParameterNames();
  object["standard_deviation"] = {{"before", JsonList(plan.deviation_before)},
                                  {"after", JsonList(plan.deviation_after)}};
  object["rivals"] = Json::array();
  for (const RivalPair& pair : plan.pairs) object["rivals"].push_back(PairObject(plan, pair));
  object["poses"] = Json::array();
  for (std::size_t k = 0; k < plan.poses.rows.size(); ++k)
    object["poses"].push_back(PoseObject(plan, k));
  object["warnings"] = plan.warnings;
  return object;
}

}  // namespace

std::string PlanJson(const std::string& dataset, const PlanOptions& options, const Plan& plan) {
  return JsonText(PlanObject(dataset, options, plan));
}

std::string PlanJsonLine(const std::string& dataset, const PlanOptions& options, const Plan& plan) {
  return JsonLine(PlanObject(dataset, options, plan));
}

}  // namespace hexcal
