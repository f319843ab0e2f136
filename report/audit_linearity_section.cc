// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "geometry/rotation_angles.h"
#include "report/audit_sections.h"
#include "report/comparison_sections.h"
#include "report/coverage.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

std::string Number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "–";
}

std::string UncertaintyText(const Estimate& nonlinear, int i) {
  if (!nonlinear.observability.determined[i]) return "–";
  return fmt::format("{:.4f} {}",
                     1e3 * std::sqrt(nonlinear.covariance(i, i)),
                     kParameters[i].is_angle ? "mrad" : "mm");
}

// The six numbers of Eq. (2) of each mount, as each solution has them.
HtmlTable EstimateTable(const Audit& audit) {
  constexpr const char* kNumbers[6] = {
      "x, mm", "y, mm", "z, mm", "rx, mrad", "ry, mrad", "rz, mrad"};
  std::vector<const BaseAndTool*> solutions = {&audit.estimate.mounts,
                                               &audit.comparison.reference.mounts};
  HtmlTable table = {{{""}, {"this report", true}, {"nonlinear", true}}, {}};
  for (const LinearizedSolution& solution : audit.linearity.solutions) {
    solutions.push_back(&solution.estimate.mounts);
    table.columns.push_back({solution.title, true});
  }
  for (int i = 0; i < 12; ++i) {
    std::vector<std::string> row = {fmt::format("{} {}", i < 6 ? "base" : "tool", kNumbers[i % 6])};
    for (const BaseAndTool* mounts : solutions)
      row.push_back(MilliText(
          VectorFromPose(i < 6 ? mounts->world_from_base : mounts->platform_from_tool)[i % 6]));
    table.rows.push_back(row);
  }
  return table;
}

// Twelve rows: how far each linearized solution is off, and how its uncertainty compares.
HtmlTable ParameterTable(const Audit& audit) {
  HtmlTable table = {{{"parameter"}, {"u", true}}, {}};
  for (const LinearizedSolution& solution : audit.linearity.solutions) {
    table.columns.push_back({solution.title + ", Δ/u", true});
    table.columns.push_back({"its u, by u", true});
  }
  for (int i = 0; i < 12; ++i) {
    std::vector<std::string> row = {std::string(kParameters[i].name),
                                    UncertaintyText(audit.comparison.reference, i)};
    for (const LinearizedSolution& solution : audit.linearity.solutions) {
      row.push_back(Number(solution.over_u[i], "{:.3g}"));
      row.push_back(Number(solution.ratio[i], "{:.4f}"));
    }
    table.rows.push_back(row);
  }
  return table;
}

HtmlTable RepeatedTable(const Audit& audit) {
  HtmlTable table = {{{"parameter"},
                      {"u by repetition, by u by first order", true},
                      {"within ±1.96 u, nominally 95 %", true}},
                     {}};
  for (std::size_t i = 0; i < audit.linearity.repeated.size(); ++i)
    table.rows.push_back({std::string(kParameters[i].name),
                          Number(audit.linearity.repeated[i].ratio, "{:.4f}"),
                          CoverageText(audit.linearity.repeated[i].coverage)});
  return table;
}

HtmlTable PointTable(const Audit& audit) {
  HtmlTable table = {{{"point"},
                      {"method"},
                      {"off at the centre, mm", true},
                      {"off at most, mm", true},
                      {"RMS ratio", true}},
                     {}};
  for (std::size_t p = 0; p < audit.requirements.points.size(); ++p)
    for (const LinearizedSolution& solution : audit.linearity.solutions)
      table.rows.push_back({audit.requirements.points[p].name,
                            solution.title,
                            fmt::format("{:.2g}", 1e3 * solution.points[p].centre),
                            fmt::format("{:.2g}", 1e3 * solution.points[p].largest),
                            Number(solution.points[p].ratio, "{:.4f}")});
  return table;
}

void AddRepetition(const Audit& audit, HtmlPage* page) {
  page->Paragraph(RepeatedText(audit.repeated, audit.estimate));
  page->Table(RepeatedTable(audit));
  HtmlTable checks = {{{"point, at worst"},
                       {"first order, mm", true},
                       {"repeated, mm", true},
                       {"± mm", true},
                       {"RMS ratio", true},
                       {"covered", true},
                       {"covered as stated", true},
                       {"agree"}},
                      {}};
  for (const PointReport& report : audit.points)
    if (report.check)
      checks.rows.push_back(
          {report.point.name,
           fmt::format("{:.5f}", 1e3 * report.check->quantile),
           fmt::format("{:.5f}", 1e3 * report.check->repeated_quantile),
           fmt::format("{:.5f}", 1e3 * report.check->standard_error),
           fmt::format("{:.4f}", report.check->repeated_rms / report.check->rms),
           CoverageText(CoverageOf(report.check->inside, report.check->draws, 0.95)),
           CoverageText(CoverageOf(report.check->inside_stated, report.check->draws, 0.95)),
           report.check->agrees ? "yes" : "no"});
  if (!checks.rows.empty()) page->Table(checks);
  page->Note(
      "The length that the error of the point does not exceed with 95 %; noise counts as known. ±: "
      "standard error of the repeated one. RMS "
      "ratio: by repetition, by first order. Covered: the share of the repetitions that are no "
      "longer than by first order, nominally 95 %, and the 95 % limits of its probability that so "
      "many "
      "repetitions confirm (binomial, Clopper and Pearson): 95 % outside of them is more than "
      "chance. Agree: the two lengths differ by no more than half a unit in the second digit of "
      "the RMS and two standard errors. Limits that leave out 95 % where the lengths agree show a "
      "difference that is there, but too small to matter. As stated: of the length that the budget "
      "and the workspace give, in which the noise may be estimated.");
}

// As wall clock times differ from run to run, they are in run.json and here alone.
void AddTimes(const std::vector<MethodTime>& times, HtmlPage* page) {
  if (times.empty()) return;
  HtmlTable table = {
      {{"method"}, {"run time, ms", true}, {"iterations", true}, {"ms an iteration", true}}, {}};
  for (const MethodTime& time : times)
    table.rows.push_back(
        {time.name,
         fmt::format("{:.3g}", 1e3 * time.seconds),
         time.iterations > 0 ? fmt::format("{}", time.iterations) : "–",
         time.iterations > 0 ? fmt::format("{:.3g}", 1e3 * time.seconds / time.iterations) : "–"});
  page->Heading("Run time");
  page->Table(table);
  page->Note("The fastest of some runs on the host named above; a dash for a closed form.");
}

}  // namespace

void AddLinearizedAgainstNonlinear(const Audit& audit,
                                   const std::vector<MethodTime>& times,
                                   HtmlPage* page) {
  page->Section("Linearized against nonlinear");
  if (audit.grown)
    page->Paragraph(
        "Of base and tool alone, from the poses without the effects as the joint fit has them; "
        "what "
        "is repeated below is the joint fit.");
  AddMethods(audit.comparison, page);
  AddTimes(times, page);
  page->Heading("Side by side");
  page->Table(EstimateTable(audit));
  page->Note(
      "The numbers of Eq. (2), of T_B^W and of T_T^A. This report: as it was asked for (section on "
      "the model); the others by all poses, each by its noise alone.");
  page->Heading("Parameter by parameter");
  page->Table(ParameterTable(audit));
  page->Note(
      "u: standard uncertainty of the nonlinear solution by poses. Δ: linearized less nonlinear. "
      "Its u, by u: the ratio of both standard uncertainties. The paper's iteration weighs all "
      "poses alike (1 m as 1 rad), so that it is off "
      "by "
      "noise, and less certain, where the nonlinear solution weighs by the noise; the twist "
      "iteration has its weights, and should end where it does: 0 off and a ratio of 1.");
  if (!audit.linearity.solutions.empty() && !audit.linearity.solutions[0].points.empty()) {
    page->Heading("At the named points");
    page->Table(PointTable(audit));
    page->Note(
        "How far apart the linearized and the nonlinear solution predict a point of the tool, in "
        "the middle of the workspace and at most over the places of its grid. RMS ratio: of the "
        "error that the calibration makes there, linearized by nonlinear.");
  }
  AddPropagation(audit.comparison.propagation, page);
  if (audit.comparison.propagation.done) AddRepetition(audit, page);
}

}  // namespace hexcal
