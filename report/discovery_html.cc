// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_html.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/discovery_charts.h"
#include "report/discovery_given.h"
#include "report/discovery_words.h"
#include "report/effect_numbers.h"
#include "report/estimate_charts.h"
#include "report/estimate_sections.h"
#include "report/html/page.h"
#include "report/quantity.h"
#include "report/residual_section.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostNumbers = 40;

Tone ToneOf(Verdict verdict) {
  if (verdict == Verdict::kUndecided) return Tone::kBad;
  return verdict == Verdict::kPartlyExplained ? Tone::kWarn : Tone::kGood;
}

void AddVerdict(const Discovery& discovery, HtmlPage* page) {
  page->Verdict(
      ToneOf(discovery.verdict), "verdict", NameOf(discovery.verdict), VerdictSentence(discovery));
  page->Paragraph(VerdictMeaning(discovery.verdict));
}

HtmlTable SizeTable(const DiscoveredEffect& found) {
  HtmlTable table = {{{"parameter"}, {"of"}, {"size ± one standard deviation", true}}, {}};
  if (found.effect.name != kUnknownEffect)
    for (const auto& [what, words] : found.effect.found) table.rows.push_back({what, "", words});
  for (const EffectParameter& parameter : ParametersOf(found.effect, found.labels)) {
    if (parameter.numbers.size() > kMostNumbers) {
      table.rows.push_back(
          {parameter.name, fmt::format("{} numbers", parameter.numbers.size()), "in model.yaml"});
      continue;
    }
    for (const EffectNumber& number : parameter.numbers)
      if (IsShown(number))
        table.rows.push_back({parameter.name,
                              number.part,
                              QuantityText(number.value, number.standard_deviation, number.unit)});
  }
  return table;
}

void AddFound(const DiscoveredEffect& found, std::size_t number, HtmlPage* page) {
  page->Heading(fmt::format("{}. {} — {}", number, found.effect.name, CarriersOf(found)));
  if (!found.description.empty()) page->Paragraph(found.description);
  const EffectKind* kind = FindEffectKind(found.effect.name);
  if (kind != nullptr && found.description.find(kind->cause) == std::string::npos)
    page->Note(std::string(kind->cause));
  page->Paragraph(
      fmt::format("Acts at: {}. Follows: {}. Shape: {}. Probability that so much appears by chance "
                  "in the whole "
                  "search: {}. Up to here, {} of the held-out position gap is closed.",
                  found.site,
                  found.driver,
                  found.shape,
                  ProbabilityText(found.p_value),
                  ShareText(found.gap_closed)));
  const HtmlTable sizes = SizeTable(found);
  if (!sizes.rows.empty()) page->Table(sizes);
  const std::vector<Chart> charts = SizeCharts(found);
  if (!charts.empty()) page->Figures(charts);
  if (found.could_also_be.empty()) return;
  page->Paragraph("These data cannot tell it from:");
  HtmlTable rivals = {{{"could also be"}, {"why, and what would tell them apart"}}, {}};
  for (const Rival& rival : found.could_also_be) rivals.rows.push_back({rival.name, rival.why});
  page->Table(rivals);
}

void AddEffects(const Discovery& discovery, HtmlPage* page) {
  page->Section("What was found");
  if (discovery.effects.empty())
    page->Paragraph(fmt::format("No effect was added to {}.",
                                discovery.given.empty() ? "base and tool" : StartOf(discovery)));
  for (std::size_t i = 0; i < discovery.effects.size(); ++i)
    AddFound(discovery.effects[i], i + 1, page);
}

void AddGap(const Discovery& discovery, HtmlPage* page) {
  page->Section("The gap, before and after");
  page->Figures(GapCharts(discovery));
  HtmlTable table = {{{""},
                      {"RMS position, mm", true},
                      {"RMS orientation, mrad", true},
                      {"chi-square", true},
                      {"degrees of freedom", true}},
                     {}};
  const auto row = [&](const char* what, const GapSize& size) {
    if (!IsKnown(size)) return;
    const bool has_test = size.degrees_of_freedom > 0;
    table.rows.push_back({what,
                          MilliText(size.rms_position),
                          MilliText(size.rms_orientation),
                          has_test ? fmt::format("{:.1f}", size.chi_square) : "",
                          has_test ? fmt::format("{}", size.degrees_of_freedom) : ""});
  };
  row("before, on the data", discovery.gap.before);
  row("after, on the data", discovery.gap.after);
  row("before, held out", discovery.gap.heldout_before);
  row("after, held out", discovery.gap.heldout_after);
  row("noise floor", discovery.gap.noise_floor);
  page->Table(table);
  page->Note(
      "Held out: each pose was predicted by a model that was searched for and fitted without it. "
      "Noise floor: what the noise of the measurement and of the parameters would leave of a model "
      "that lacks nothing.");
}

void AddResiduals(const Scene& scene, const PoseResiduals& residuals, HtmlPage* page) {
  if (residuals.labels.empty()) return;
  page->Section("What is left over");
  AddResidualPictures(residuals, scene, page);
}

// How both fits arrived.
void AddConvergence(const Discovery& discovery, HtmlPage* page) {
  page->Section("How the fits were found");
  std::vector<Chart> charts = {
      ConvergenceChart(discovery.base_and_tool.iterations, "fit of base and tool alone")};
  if (discovery.refit.size() > 0)
    charts.push_back(ConvergenceChart(discovery.refit, "fit of base, tool and effects"));
  page->Figures(charts);
}

void AddSteps(const Discovery& discovery, HtmlPage* page) {
  if (discovery.steps.empty()) return;
  page->Section("How it was found");
  const Chart steps = StepChart(discovery);
  if (discovery.effects.empty())
    page->Table(steps.table);
  else
    page->Figure(steps);
  std::vector<Chart> rankings;
  for (std::size_t i = 0; i < discovery.steps.size(); ++i)
    if (!discovery.steps[i].candidates.empty())
      rankings.push_back(RankingChart(discovery.steps[i], i + 1));
  page->Figures(rankings);
}

// The smallest p first.
TitledTable WhereTable(const char* title, std::vector<WhereItem> items) {
  constexpr std::size_t kMostRows = 10;
  std::stable_sort(items.begin(), items.end(), [](const WhereItem& a, const WhereItem& b) {
    return a.p_value < b.p_value;
  });
  HtmlTable table = {{{"where"}, {"p", true}, {"share", true}}, {}};
  for (const WhereItem& item : items) {
    if (table.rows.size() == kMostRows) break;
    table.rows.push_back({item.what, ProbabilityText(item.p_value), ShareText(item.share)});
  }
  if (items.size() > kMostRows)
    table.rows.push_back(
        {fmt::format("{} more, in discovery.json", items.size() - kMostRows), "", ""});
  return {title, table};
}

void AddWhere(const Where& where, const std::string& start, HtmlPage* page) {
  page->Section("Where the disagreement is");
  page->Paragraph(fmt::format("Of prediction and measurement with {}.", start));
  page->Note(
      "p: the probability of as much by chance, corrected for the length of its list. Share: of "
      "the disagreement beyond noise that it holds; shares overlap. The smallest p first.");
  std::vector<TitledTable> tables;
  const auto add = [&tables](const char* title, const std::vector<WhereItem>& items) {
    if (!items.empty()) tables.push_back(WhereTable(title, items));
  };
  add("By frame of origin", where.sites);
  add("By what it follows", where.covariates);
  add("By leg", where.legs);
  add("By axis", where.axes);
  add("By pose", where.poses);
  page->Tables(tables);
}

void AddNoise(const Discovery& discovery, HtmlPage* page) {
  page->Section("Noise");
  const std::vector<std::string> found = NoiseSentences(discovery.noise);
  if (found.empty())
    page->Paragraph("The noise is what the dataset states.");
  else
    page->List(found);
  const NoiseSummary& noise = discovery.estimate.noise;
  page->Paragraph(fmt::format("The final model's measured poses have {} and {} a coordinate ({}).",
                              SizeText(noise.position, "m"),
                              SizeText(noise.orientation, "rad"),
                              noise.estimated ? "estimated" : "as stated"));
}

void AddLimits(const Discovery& discovery, HtmlPage* page) {
  page->Section("What could not be seen");
  if (!discovery.not_testable.empty()) {
    page->Heading("Not testable with these data");
    HtmlTable table = {{{"effect"}, {"needs"}}, {}};
    for (const NotTestable& effect : discovery.not_testable)
      table.rows.push_back({effect.name, effect.needs});
    page->Table(table);
  }
  if (discovery.detectable.empty()) return;
  page->Heading("The smallest size that would be found");
  page->Note("In four data sets of five like this one; smaller effects may be there unseen.");
  HtmlTable table = {{{"effect"}, {"smallest", true}}, {}};
  for (const Detectable& effect : discovery.detectable)
    table.rows.push_back(
        {NameWithIndex(effect.name, effect.index), SizeText(effect.smallest, effect.unit)});
  page->Table(table);
}

}  // namespace

std::string DiscoveryHtml(const std::string& dataset,
                          const RunRecord& record,
                          const Discovery& discovery,
                          const Scene& scene,
                          const PoseResiduals& residuals) {
  HtmlPage page("discover",
                "Gap discovery: " + dataset,
                fmt::format("{} poses · where prediction and measurement disagree, what is missing "
                            "in the model, and how the gap shrinks",
                            discovery.poses.size()));
  AddVerdict(discovery, &page);
  AddGiven(discovery, &page);
  AddEffects(discovery, &page);
  AddGap(discovery, &page);
  AddResiduals(scene, residuals, &page);
  AddSteps(discovery, &page);
  AddWhere(discovery.where, StartOf(discovery), &page);
  AddNoise(discovery, &page);
  AddLimits(discovery, &page);
  AddMounts(discovery.estimate, &page);
  AddConvergence(discovery, &page);
  AddReproduction(record, discovery.warnings, "result.json, model.yaml and discovery.json", &page);
  return page.Html();
}

}  // namespace hexcal
