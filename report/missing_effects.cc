// SPDX-License-Identifier: BSD-3-Clause
#include "report/missing_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/audit_json_parts.h"
#include "report/chart_parts.h"
#include "report/json_parts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBars = 12;
constexpr double kCoverage = 2.0;     // of what an effect could be
constexpr double kMostDigits = 30.0;  // of a p that still gets a bar of its own length

std::string LabelOf(const Hypothesis& one) {
  if (one.labels.empty()) return one.name;
  if (one.labels.size() > 2) {
    // "base joint 1 to 6": short, for narrow screens.
    const std::string& last = one.labels.back();
    return fmt::format(
        "{} ({} to {})", one.name, one.labels.front(), last.substr(last.rfind(' ') + 1));
  }
  return fmt::format("{} ({})", one.name, fmt::join(one.labels, ", "));
}

// An effect without a name that could use up what a requirement leaves.
struct NotExcluded {
  const Hypothesis* effect = nullptr;
  const Decision* decision = nullptr;
  double could_move = 0.0, leaves = 0.0;  // m
};

std::vector<NotExcluded> NotExcludedIn(const Audit& audit) {
  std::vector<NotExcluded> found;
  for (const Decision& decision : audit.decisions) {
    const double leaves = decision.requirement.limit - decision.value - decision.guard;
    if (!(leaves > 0.0)) continue;
    const std::size_t point = decision.requirement.point;
    for (const Hypothesis& one : audit.missing->tested) {
      if (one.is_named || point >= one.at_points.size()) continue;
      const double could = one.at_points[point] + kCoverage * one.at_points_uncertainty[point];
      if (!(could <= leaves)) found.push_back({&one, &decision, could, leaves});
    }
  }
  return found;
}

const std::string& PointOf(const Audit& audit, const NotExcluded& one) {
  return audit.requirements.points[one.decision->requirement.point].name;
}

std::string SentenceOf(const Audit& audit, const NotExcluded& one) {
  return fmt::format("{}: up to {} at {} (RMS over the measured poses, with 2 u); {} leaves {}.",
                     LabelOf(*one.effect),
                     SizeText(one.could_move, "m"),
                     PointOf(audit, one),
                     one.decision->requirement.name,
                     SizeText(one.leaves, "m"));
}

void AddNotExcluded(const Audit& audit, HtmlPage* page) {
  const std::vector<NotExcluded> found = NotExcludedIn(audit);
  if (found.empty()) return;
  page->Paragraph(
      "The data do not ask for these, and do not exclude either that they use up what a "
      "requirement leaves (its limit less the value and the guard band); more or other poses "
      "would tell:");
  std::vector<std::string> sentences;
  for (const NotExcluded& one : found) sentences.push_back(SentenceOf(audit, one));
  page->List(sentences);
}

// What is not told, wholly or in part.
void AddNotTestable(const Screening& missing, HtmlPage* page) {
  HtmlTable table = {{{"effect"}, {"needs"}}, {}};
  for (const NotTestable& one : missing.not_testable) table.rows.push_back({one.name, one.needs});
  for (const Hypothesis& one : missing.tested)
    if (one.told < one.directions)
      table.rows.push_back({LabelOf(one),
                            fmt::format("in part: {} of {} directions among its numbers need other "
                                        "poses or markers",
                                        one.directions - one.told,
                                        one.directions)});
  if (table.rows.empty()) return;
  page->Heading("Not testable with these poses");
  page->Table(table);
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
                      {"told", true},
                      {"size ± u", true}},
                     {}};
  for (const NamedPoint& point : audit.requirements.points)
    table.columns.push_back({fmt::format("at {} ± u, mm", point.name), true});
  for (const char* heading : {"ΔAIC", "ΔBIC"}) table.columns.push_back({heading, true});
  for (const Hypothesis& one : audit.missing->tested) {
    std::vector<std::string> row = {LabelOf(one),
                                    one.is_named ? "named" : "not\u00a0named",
                                    fmt::format("{:.1f}", one.gain),
                                    fmt::format("{}", one.parameters),
                                    ProbabilityText(one.p_value),
                                    fmt::format("{} of {}", one.told, one.directions),
                                    QuantityText(one.size, one.standard_uncertainty, one.unit)};
    for (std::size_t p = 0; p < one.at_points.size(); ++p)
      row.push_back(fmt::format(
          "{:.4f} ± {:.4f}", 1e3 * one.at_points[p], 1e3 * one.at_points_uncertainty[p]));
    row.push_back(fmt::format("{:.1f}", one.aic_change));
    row.push_back(fmt::format("{:.1f}", one.bic_change));
    table.rows.push_back(row);
  }
  return table;
}

Chart TestedChart(const Screening& missing) {
  Chart chart;
  chart.title = "How much the data ask for each effect";
  const std::size_t bars = std::min(missing.tested.size(), kMostBars);
  const std::string which =
      bars < missing.tested.size()
          ? fmt::format("the first {} of the {} effects in the table", bars, missing.tested.size())
          : "each effect";
  chart.shows = fmt::format(
      "-log10 of the corrected p of {}, the smallest p first, and the level of {} that a name asks "
      "for.",
      which,
      ProbabilityText(missing.alpha));
  chart.good =
      "every bar ends before the line: the model lacks nothing that these data could show.";
  std::vector<std::string> names;
  Json lengths = Json::array();
  for (std::size_t k = 0; k < bars; ++k) {
    const Hypothesis& one = missing.tested[k];
    names.push_back(LabelOf(one));
    lengths.push_back(one.p_value > 0.0 ? std::min(-std::log10(one.p_value), kMostDigits)
                                        : kMostDigits);
  }
  const double level = -std::log10(missing.alpha);
  chart.data = Json::array({NamedBars(names, lengths, "%{x:.2f}", &chart)});
  chart.layout["xaxis"] = Axis("-log10 p, corrected", true);
  chart.layout["shapes"] = Json::array({{{"type", "line"},
                                         {"x0", level},
                                         {"x1", level},
                                         {"yref", "paper"},
                                         {"y0", 0},
                                         {"y1", 1},
                                         {"layer", "below"},
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
    AddNotExcluded(audit, page);
    page->Figure(TestedChart(missing));
  }
  page->Note(
      "Named: discovery would add it, being the best of those whose p is below the level; others "
      "with a small p are rivals, which are tested again once it is in the model. -Δχ²: how far "
      "chi-square falls with dof numbers more. p: that chance explains so much, corrected for the "
      "search within an effect (a leg, a period) and for all hypotheses, among them descriptions "
      "without a cause, which stand here only where one is named. Told: the directions among the "
      "numbers of the effect's best form that the data tell, of all: those whose variance they "
      "bring below a tenth of the prior's, whose standard deviation is thirty plausible sizes "
      "(those of docs/effects.md). Size and point are of the told directions alone, by least "
      "squares in which the prior has no part; the others count as zero there. Size: the largest "
      "number, with its standard uncertainty u. At a point: the RMS over the measured poses of "
      "what its neglect does there after base and tool have taken their part, and the RMS standard "
      "uncertainty of that displacement, which chance alone reaches. AIC and BIC fall where the "
      "effect is worth its numbers; the search is not in them.");
  AddNotTestable(missing, page);
}

nlohmann::ordered_json JsonMissingEffects(const Audit& audit) {
  if (!audit.missing) return {};
  const Screening& missing = *audit.missing;
  Json tested = Json::array(), absent = Json::array(), not_excluded = Json::array();
  for (const Hypothesis& one : missing.tested) {
    Json points = Json::array();
    for (std::size_t p = 0; p < one.at_points.size(); ++p)
      points.push_back({{"point", audit.requirements.points[p].name},
                        {"rms", JsonNumber(one.at_points[p])},
                        {"standard_uncertainty", JsonNumber(one.at_points_uncertainty[p])}});
    tested.push_back({{"effect", one.name},
                      {"labels", one.labels},
                      {"verdict", one.is_named ? "named" : "not named"},
                      {"chi_square_fall", JsonNumber(one.gain)},
                      {"degrees_of_freedom", one.parameters},
                      {"p_value", JsonNumber(one.p_value)},
                      {"own_p_value", JsonNumber(one.own_p_value)},
                      {"directions", one.directions},
                      {"told", one.told},
                      {"size", JsonNumber(one.size)},
                      {"standard_uncertainty", JsonNumber(one.standard_uncertainty)},
                      {"unit", one.unit},
                      {"points", points},
                      {"aic_change", JsonNumber(one.aic_change)},
                      {"bic_change", JsonNumber(one.bic_change)}});
  }
  for (const NotTestable& one : missing.not_testable)
    absent.push_back({{"effect", one.name}, {"needs", one.needs}});
  for (const NotExcluded& one : NotExcludedIn(audit))
    not_excluded.push_back({{"effect", one.effect->name},
                            {"requirement", one.decision->requirement.name},
                            {"point", PointOf(audit, one)},
                            {"could_move", JsonNumber(one.could_move)},
                            {"leaves", JsonNumber(one.leaves)}});
  return {{"alpha", missing.alpha},
          {"hypotheses", missing.hypotheses},
          {"poses", missing.poses},
          {"of", missing.of},
          {"named", missing.named},
          {"tested", tested},
          {"not_excluded", not_excluded},
          {"not_testable", absent}};
}

}  // namespace hexcal
