// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/effect_json.h"
#include "report/effect_numbers.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

// More of the calibration's variance than this on priors is not what the data say.
constexpr double kMostByPriors = 0.1;

}  // namespace

void KeepReached(const GrownTarget& grown, std::vector<Place>* places) {
  places->erase(std::remove_if(places->begin(),
                               places->end(),
                               [&grown](const Place& place) {
                                 return !grown.At(place.base_from_platform, place.row);
                               }),
                places->end());
}

std::vector<Place> PosesOf(const GrownSolution& solution) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < solution.rows.size(); ++i) {
    const Observation& o = solution.observations.items[i];
    places.push_back({o.label, o.base_from_platform, solution.rows[i]});
  }
  return places;
}

void AddDoubtsOfModel(const Audit& audit, std::vector<std::string>* doubts) {
  if (!audit.grown) return;
  const GrownSolution& solution = audit.grown->solution();
  for (const std::string& held : solution.Held())
    doubts->push_back(held + " is taken as the model has it: its uncertainty is not in the error");
  for (const std::string& lost : solution.NotDetermined())
    doubts->push_back("the data do not determine " + lost);
  for (const PointReport& report : audit.points)
    if (report.worst.by_priors > kMostByPriors)
      doubts->push_back(
          fmt::format("where the error of {} is worst, {} of the calibration's variance rests on "
                      "plausible sizes of effects, not on the data",
                      report.point.name,
                      ShareText(report.worst.by_priors)));
}

void AddModelEffects(const Audit& audit, HtmlPage* page) {
  const GrownSolution& solution = audit.grown->solution();
  page->Heading("Effects of the model");
  page->Paragraph(
      "Fitted along with base and tool; the error of a point holds their uncertainty and its "
      "correlation with the mounts. Effects of the tracker and of markers do not move the tool: "
      "they count by that correlation alone.");
  if (!audit.bodies.empty())
    page->Paragraph(
        "This fit is by poses, made of the markers' readings, not by the readings themselves as "
        "without a model.");
  HtmlTable table = {{{"effect"}, {"number"}, {"value", true}, {"standard uncertainty", true}}, {}};
  for (std::size_t e = 0; e < solution.fit.effects.size(); ++e) {
    const Effect& effect = solution.fit.effects[e];
    const EffectKind* kind = FindEffectKind(effect.name);
    if (kind == nullptr || kind->IsFault()) {
      table.rows.push_back({effect.name, "as in the model", "", ""});
      continue;
    }
    for (const int number : solution.effects[e].free) {
      const std::string unit(kind->UnitOf(number));
      const double sigma = effect.standard_deviation[number];
      table.rows.push_back({effect.name,
                            FreeNumberName(*kind, number),
                            SizeText(effect.parameters[number], unit),
                            std::isfinite(sigma) ? SizeText(sigma, unit) : "not determined"});
    }
  }
  if (solution.data.pose_map) table.rows.push_back({"pose map", "as in the model", "", ""});
  page->Table(table);
  page->Note(
      "At a place of the workspace the effects act as if the robot went there once more after the "
      "last row of the dataset, from the centre of the travel, and stood still: at that row's "
      "time, with the mean temperature, payload and other columns of the rows.");
}

nlohmann::ordered_json JsonModel(const Audit& audit) {
  const GrownSolution& solution = audit.grown->solution();
  nlohmann::ordered_json json;
  json["effects"] = nlohmann::ordered_json::array();
  for (const Effect& effect : solution.fit.effects) json["effects"].push_back(JsonEffect(effect));
  json["held"] = solution.Held();
  json["not_determined"] = solution.NotDetermined();
  json["by_priors"] = nlohmann::ordered_json::array();
  for (const PointReport& report : audit.points)
    json["by_priors"].push_back({{"point", report.point.name}, {"share", report.worst.by_priors}});
  return json;
}

}  // namespace hexcal
