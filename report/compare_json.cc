// SPDX-License-Identifier: BSD-3-Clause
#include "report/compare_json.h"

#include <algorithm>

#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json MethodObject(const MethodResult& result) {
  Json held_out;
  if (result.held_out)
    held_out = {{"position", result.held_out->position},
                {"orientation", result.held_out->orientation},
                {"not_converged", result.held_out->not_converged}};
  return {{"name", std::string(InfoOf(result.method).name)},
          {"converged", result.fit.converged},
          {"message", result.fit.message},
          {"world_from_base", JsonPose(result.fit.mounts.world_from_base)},
          {"platform_from_tool", JsonPose(result.fit.mounts.platform_from_tool)},
          {"difference", JsonList(result.sigmas)},
          {"rmspe", result.rmspe},
          {"rmsoe", result.rmsoe},
          {"held_out", held_out},
          {"iterations", JsonIterations(result.fit.iterations)}};
}

Json PropagationObject(const PropagationCheck& check) {
  Json object = {{"done", check.done}, {"why", check.why_not}};
  if (!check.done) return object;
  object["validated"] = check.validated;
  object["stable"] = check.stable;
  object["draws"] = check.draws;
  object["not_converged"] = check.not_converged;
  object["intervals"] = Json::array();
  for (int i = 0; i < 12; ++i) {
    const IntervalCheck& c = check.intervals[i];
    object["intervals"].push_back({{"parameter", std::string(kParameters[i].name)},
                                   {"sigma", c.sigma},
                                   {"tolerance", c.tolerance},
                                   {"low", c.low},
                                   {"high", c.high},
                                   {"low_difference", c.low_difference},
                                   {"high_difference", c.high_difference},
                                   {"accuracy", c.accuracy},
                                   {"bias", c.bias},
                                   {"agrees", c.agrees}});
  }
  return object;
}

Json MapObject(const char* method, const ConvergenceMap& map, const CompareOptions& options) {
  return {{"method", method},
          {"iterations", options.calibrate.linearized.max_iterations},
          {"starts", options.starts},
          {"has_limit", map.has_limit},
          {"rotation_errors", map.rotation_errors},
          {"translation_errors", map.translation_errors},
          {"share", map.share}};
}

Json CompareObject(const std::string& dataset,
                   const CompareOptions& options,
                   const Comparison& comparison) {
  const Estimate& reference = comparison.reference;
  Json object;
  object["format"] = "hexcal/compare/1";
  object["dataset"] = dataset;
  object["poses"] = reference.poses.size();
  object["seed"] = options.seed;
  object["parameters"] = JsonParameterNames();
  object["standard_deviation"] =
      JsonStandardDeviations(reference.covariance, reference.observability);
  object["noise"] = {{"position", reference.noise.position},
                     {"orientation", reference.noise.orientation},
                     {"estimated", reference.noise.estimated}};
  object["folds"] = comparison.folds;
  object["methods"] = Json::array();
  for (const MethodResult& result : comparison.methods)
    object["methods"].push_back(MethodObject(result));
  object["certificate"] = JsonCertificate(comparison.certificate);
  object["propagation"] = PropagationObject(comparison.propagation);
  object["convergence"] = {MapObject("paper", comparison.paper_map, options),
                           MapObject("twist", comparison.twist_map, options)};
  object["warnings"] = reference.warnings;
  return object;
}

}  // namespace

std::string CompareJson(const std::string& dataset,
                        const CompareOptions& options,
                        const Comparison& comparison) {
  return JsonText(CompareObject(dataset, options, comparison));
}

std::string CompareJsonLine(const std::string& dataset,
                            const CompareOptions& options,
                            const Comparison& comparison) {
  return JsonLine(CompareObject(dataset, options, comparison));
}

std::vector<MethodTime> TimesOf(const Comparison& comparison) {
  std::vector<MethodTime> times;
  for (const MethodResult& result : comparison.methods)
    times.push_back({std::string(InfoOf(result.method).name),
                     result.seconds,
                     std::max(0, static_cast<int>(result.fit.iterations.size()) - 1)});
  return times;
}

}  // namespace hexcal
