// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_json.h"

#include "report/discovery_given.h"
#include "report/effect_json.h"
#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

template <typename Items, typename Write>
Json ListOf(const Items& items, Write write) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(write(item));
  return list;
}

Json Size(const GapSize& size) {
  return {{"rms_position", size.rms_position},
          {"rms_orientation", size.rms_orientation},
          {"chi_square", size.chi_square},
          {"degrees_of_freedom", size.degrees_of_freedom}};
}

Json GapObject(const Gap& gap) {
  return {{"before", Size(gap.before)},
          {"after", Size(gap.after)},
          {"heldout_before", Size(gap.heldout_before)},
          {"heldout_after", Size(gap.heldout_after)},
          {"noise_floor", Size(gap.noise_floor)}};
}

Json FoundEffect(const DiscoveredEffect& found) {
  Json effect = {{"name", found.effect.name},
                 {"site", found.site},
                 {"index", found.effect.index},
                 {"labels", found.labels},
                 {"driver", found.driver},
                 {"shape", found.shape},
                 {"parameters", JsonParameters(found.effect)},
                 {"standard_deviation", JsonDeviations(found.effect)},
                 {"units", JsonUnits(found.effect)}};
  AddDescription(found.effect, &effect);
  effect["p_value"] = found.p_value;
  effect["log10_p"] = found.log10_p;
  effect["gap_closed"] = found.gap_closed;
  effect["could_also_be"] = ListOf(found.could_also_be, [](const Rival& rival) {
    return Json{{"name", rival.name}, {"why", rival.why}};
  });
  effect["description"] = found.description;
  return effect;
}

Json GeometryObject(const GeometryClass& geometry) {
  Json bounds = Json::object();
  for (const Bound& bound : geometry.bounds)
    bounds[bound.name] = {{"value", bound.value},
                          {"lower", bound.lower},
                          {"upper", bound.upper},
                          {"unit", bound.unit}};
  return {{"in_model", geometry.is_in_model},
          {"complete", geometry.is_complete},
          {"bounds", bounds},
          {"yaw", geometry.yaw},
          {"error_size", geometry.error_size},
          {"after", Size(geometry.after)},
          {"heldout", Size(geometry.heldout)},
          {"heldout_map", Size(geometry.heldout_map)}};
}

Json Candidate(const CandidateScore& candidate) {
  return {{"name", candidate.name},
          {"index", candidate.index},
          {"score", candidate.score},
          {"p_value", candidate.p_value},
          {"log10_p", candidate.log10_p}};
}

Json StepObject(const Step& step) {
  return {{"candidates", ListOf(step.candidates, Candidate)},
          {"added", step.added.empty() ? Json() : Json(step.added)},
          {"p_value", step.p_value},
          {"after", Size(step.after)}};
}

Json WhereObject(const Where& where) {
  const auto list = [](const std::vector<WhereItem>& items) {
    return ListOf(items, [](const WhereItem& item) {
      return Json{{"what", item.what}, {"p_value", item.p_value}, {"share", item.share}};
    });
  };
  return {{"poses", list(where.poses)},
          {"legs", list(where.legs)},
          {"axes", list(where.axes)},
          {"covariates", list(where.covariates)},
          {"sites", list(where.sites)}};
}

Json NoiseObject(const NoiseFound& noise) {
  return {{"scale", noise.scale},
          {"robot_position", noise.robot_position},
          {"robot_orientation", noise.robot_orientation},
          {"tail_freedom", noise.tail_freedom > 0 ? Json(noise.tail_freedom) : Json()},
          {"correlation", noise.correlation},
          {"shape_scale", noise.shape_scale}};
}

Json PoseObject(const PoseGap& pose) {
  Json object = {{"pose", pose.label},
                 {"row", pose.row},
                 {"weight", pose.weight},
                 {"before", JsonList(pose.before)},
                 {"after", JsonList(pose.after)}};
  if (!pose.leg_lengths) return object;
  object["leg_lengths"] = JsonList(*pose.leg_lengths);
  object["legs_before"] = JsonList(pose.legs_before);
  object["legs_after"] = JsonList(pose.legs_after);
  return object;
}

Json DiscoveryObject(const std::string& dataset,
                     const DiscoverOptions& options,
                     const Discovery& discovery) {
  Json object;
  object["format"] = "hexcal/discovery/1";
  object["dataset"] = dataset;
  object["verdict"] = std::string(NameOf(discovery.verdict));
  object["settings"] = {{"alpha", options.alpha},
                        {"bootstraps", options.bootstraps},
                        {"folds", options.folds},
                        {"most_effects", options.most_effects},
                        {"seed", options.seed}};
  object["not_testable"] = ListOf(discovery.not_testable, [](const NotTestable& effect) {
    return Json{{"name", effect.name}, {"needs", effect.needs}};
  });
  object["detectable"] = ListOf(discovery.detectable, [](const Detectable& effect) {
    return Json{{"name", effect.name},
                {"index", effect.index},
                {"smallest", effect.smallest},
                {"unit", effect.unit}};
  });
  object["gap"] = GapObject(discovery.gap);
  if (!discovery.given.empty()) object["given"] = JsonGiven(discovery);
  object["effects"] = ListOf(discovery.effects, FoundEffect);
  if (discovery.leg_geometry) object["leg_geometry"] = GeometryObject(*discovery.leg_geometry);
  object["steps"] = ListOf(discovery.steps, StepObject);
  object["where"] = WhereObject(discovery.where);
  object["noise"] = NoiseObject(discovery.noise);
  object["poses"] = ListOf(discovery.poses, PoseObject);
  object["warnings"] = discovery.warnings;
  return object;
}

}  // namespace

std::string DiscoveryJson(const std::string& dataset,
                          const DiscoverOptions& options,
                          const Discovery& discovery) {
  return JsonText(DiscoveryObject(dataset, options, discovery));
}

std::string DiscoveryJsonLine(const std::string& dataset,
                              const DiscoverOptions& options,
                              const Discovery& discovery) {
  return JsonLine(DiscoveryObject(dataset, options, discovery));
}

}  // namespace hexcal
