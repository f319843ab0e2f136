// SPDX-License-Identifier: BSD-3-Clause
#include "report/missing_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/audit_json_parts.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/json_parts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBars = 12;
constexpr double kMostDigits = 30.0;  // of a p that still gets a bar of its own length

std::string LabelOf(const Hypothesis& one) {
  if (one.labels.empty()) return one.name;
  if (one.labels.size() > 2)
    return fmt::format("{} ({} to {})", one.name, one.labels.front(), one.labels.back());
  return fmt::format("{} ({})", one.name, fmt::join(one.labels, ", "));
}

// What to do about it.
const char* Remedy(const Audit& audit) {
  return audit.grown ? "hexcal discover --model with the same model finds it and writes a model "
                       "that has it, then hexcal audit --model with that"
                     : "hexcal discover finds it and writes a model.yaml, then hexcal audit "
                       "--model=model.yaml";
}

HtmlTable TestedTable(const Audit& audit) {
  HtmlTable table = {{{"effect"},
                      {"verdict"},
                      {"-Δχ²", true},
                      {"dof", true},
                      {"p, corrected", true},
                      {"size ± u", true}},
                     {}};
  for (const NamedPoint& point : audit.requirements.points)
    table.columns.push_back({fmt::format("at {}, mm", point.name), true});
  for (const char* heading : {"ΔAIC", "ΔBIC"}) table.columns.push_back({heading, true});
  for (const Hypothesis& one : audit.missing->tested) {
    std::vector<std::string> row = {LabelOf(one),
                                    one.is_named ? "named" : "not\u00a0named",
                                    fmt::format("{:.1f}", one.gain),
                                    fmt::format("{}", one.parameters),
                                    ProbabilityText(one.p_value),
                                    QuantityText(one.size, one.standard_uncertainty, one.unit)};
    for (const double length : one.at_points) row.push_back(fmt::format("{:.4f}", 1e3 * length));
    row.push_back(fmt::format("{:.1f}", one.aic_change));
    row.push_back(fmt::format("{:.1f}", one.bic_change));
    table.rows.push_back(row);
  }
  return table;
}

Chart TestedChart(const Screening& missing) {
  Chart chart;
  chart.title = "How much the data ask for each effect";
  chart.shows = fmt::format(
      "-log10 of the corrected p of each effect, the smallest first, and the level of {} that a "
      "name asks for.",
      ProbabilityText(missing.alpha));
  chart.good =
      "every bar ends before the line: the model lacks nothing that these data could show.";
  Json names = Json::array(), lengths = Json::array();
  for (std::size_t k = 0; k < std::min(missing.tested.size(), kMostBars); ++k) {
    const Hypothesis& one = missing.tested[k];
    names.push_back(EscapeLabel(LabelOf(one)));
    lengths.push_back(one.p_value > 0.0 ? std::min(-std::log10(one.p_value), kMostDigits)
                                        : kMostDigits);
  }
  const double level = -std::log10(missing.alpha);
  chart.layout["height"] = 130 + 26 * static_cast<int>(names.size());
  chart.data = Json::array({{{"type", "bar"},
                             {"orientation", "h"},
                             {"y", names},
                             {"x", lengths},
                             {"marker", {{"color", "@after"}}},
                             {"hovertemplate", "%{y}: %{x:.2f}<extra></extra>"}}});
  Json y = OpenAxis("");
  y["autorange"] = "reversed";
  chart.layout["yaxis"] = y;
  chart.layout["xaxis"] = Axis("-log10 p, corrected", true);
  chart.layout["shapes"] = Json::array({{{"type", "line"},
                                         {"x0", level},
                                         {"x1", level},
                                         {"yref", "paper"},
                                         {"y0", 0},
                                         {"y1", 1},
                                         {"line", {{"color", "@floor"}, {"dash", "dash"}}}}});
  return chart;
}

}  // namespace

void AddDoubtsOfMissing(const Audit& audit, std::vector<std::string>* doubts) {
  if (!audit.missing) {
    if (!audit.why_not_screened.empty() && !audit.global.is_rounding)
      doubts->push_back("effects that the model lacks were not looked for: " +
                        audit.why_not_screened);
    return;
  }
  for (const std::string& name : audit.missing->named)
    doubts->push_back(
        fmt::format("the data ask for what the model lacks: {} ({})", name, Remedy(audit)));
}

void AddMissingEffects(const Audit& audit, HtmlPage* page) {
  page->Section("Missing effects");
  if (!audit.missing)
    return page->Paragraph(
        "Effects that the model lacks were not looked for" +
        (audit.why_not_screened.empty() ? std::string(".") : ": " + audit.why_not_screened + "."));
  const Screening& missing = *audit.missing;
  page->Paragraph(fmt::format(
      "{} Each was tested by itself, {} adjusted along with it, against noise that is estimated "
      "anew, from {} poses{}. Of data that lack nothing, one in {:.0f} would get a name by chance.",
      missing.named.empty()
          ? fmt::format("None of {} hypotheses has a name to add to the model.", missing.hypotheses)
          : fmt::format("The data ask for what the model lacks: {}. Nothing passes before it is in "
                        "the model: {}.",
                        fmt::join(missing.named, "; "),
                        Remedy(audit)),
      audit.grown ? "base, tool and the effects of the model" : "base and tool",
      missing.poses,
      missing.poses < missing.of ? fmt::format(" (evenly, of {})", missing.of) : "",
      1.0 / missing.alpha));
  if (!missing.tested.empty()) {
    page->Table(TestedTable(audit));
    page->Figure(TestedChart(missing));
  }
  page->Note(
      "Named: discovery would add it, being the best of those whose p is below the level; others "
      "with a small p are rivals, which are tested again once it is in the model. -Δχ²: how far "
      "chi-square falls with dof numbers more. p: that chance explains so much, corrected for the "
      "search within an effect (a leg, a period) and for all hypotheses, among them descriptions "
      "without a cause, which stand here only where one is named. Size: the largest number of the "
      "effect's best form, with its standard uncertainty u. At a point: the RMS over the measured "
      "poses of what its neglect does there after base and tool have taken their part. AIC and BIC "
      "fall where the effect is worth its numbers; the search is not in them.");
  if (missing.not_testable.empty()) return;
  page->Heading("Not testable with these poses");
  HtmlTable table = {{{"effect"}, {"needs"}}, {}};
  for (const NotTestable& one : missing.not_testable) table.rows.push_back({one.name, one.needs});
  page->Table(table);
}

nlohmann::ordered_json JsonMissingEffects(const Audit& audit) {
  if (!audit.missing) return {};
  const Screening& missing = *audit.missing;
  Json tested = Json::array(), absent = Json::array();
  for (const Hypothesis& one : missing.tested) {
    Json points = Json::array();
    for (std::size_t p = 0; p < one.at_points.size(); ++p)
      points.push_back(
          {{"point", audit.requirements.points[p].name}, {"rms", JsonNumber(one.at_points[p])}});
    tested.push_back({{"effect", one.name},
                      {"labels", one.labels},
                      {"verdict", one.is_named ? "named" : "not named"},
                      {"chi_square_fall", JsonNumber(one.gain)},
                      {"degrees_of_freedom", one.parameters},
                      {"p_value", JsonNumber(one.p_value)},
                      {"own_p_value", JsonNumber(one.own_p_value)},
                      {"size", JsonNumber(one.size)},
                      {"standard_uncertainty", JsonNumber(one.standard_uncertainty)},
                      {"unit", one.unit},
                      {"points", points},
                      {"aic_change", JsonNumber(one.aic_change)},
                      {"bic_change", JsonNumber(one.bic_change)}});
  }
  for (const NotTestable& one : missing.not_testable)
    absent.push_back({{"effect", one.name}, {"needs", one.needs}});
  return {{"alpha", missing.alpha},
          {"hypotheses", missing.hypotheses},
          {"poses", missing.poses},
          {"of", missing.of},
          {"named", missing.named},
          {"tested", tested},
          {"not_testable", absent}};
}

}  // namespace hexcal
