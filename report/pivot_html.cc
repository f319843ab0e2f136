// SPDX-License-Identifier: BSD-3-Clause
#include "report/pivot_html.h"

#include <fmt/format.h>

#include <cmath>

#include "report/estimate_sections.h"
#include "report/html/page.h"
#include "report/pivot_charts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

bool IsDetermined(const PivotResult& result, int row) {
  return row < 3 ? result.IsDetermined(row) : result.lost_count() == 0;
}

// Why the standard deviations may not be true; empty where they may.
std::string DoubtsOf(const PivotResult& result) {
  std::string doubts;
  if (result.HasTooMuchLeftOver())
    doubts = fmt::format("What is left over is {:.2f} times what the stated noise explains.",
                         std::sqrt(result.chi_square / result.degrees_of_freedom_of_fit));
  if (const long used = result.used_outliers(); used > 0)
    doubts += fmt::format(
        "{}{} that the others contradict {} used all the same "
        "(--outliers=reject leaves such out).",
        doubts.empty() ? "" : " ",
        used == 1 ? "A reading" : fmt::format("{} readings", used),
        used == 1 ? "was" : "were");
  return doubts;
}

void AddVerdict(const PivotResult& result, HtmlPage* page) {
  if (!result.converged)
    return page->Verdict(
        Tone::kBad, "verdict", "not converged", "The fit did not arrive: there is no tip.");
  if (result.lost_count() > 0)
    return page->Verdict(Tone::kBad,
                         "verdict",
                         "not determined",
                         fmt::format("The readings do not tilt the tool enough: the tip is not "
                                     "determined along {} of three directions.",
                                     result.lost_count()));
  const std::string rms = SizeText(std::sqrt(result.covariance.topLeftCorner<3, 3>().trace()), "m");
  const std::string left_over = SizeText(result.rms, "m");
  const std::string doubts = DoubtsOf(result);
  if (!doubts.empty())
    return page->Verdict(
        Tone::kWarn,
        "verdict",
        "determined, but doubtful",
        fmt::format(
            "{} So the tip may be further off than the {} that its three standard "
            "deviations together say (root of the sum of their squares); {} RMS are left over.",
            doubts,
            rms,
            left_over));
  page->Verdict(Tone::kGood,
                "verdict",
                "determined",
                fmt::format("The tip is known to {} (root of the sum of squares of its three "
                            "standard deviations); {} RMS are left over.",
                            rms,
                            left_over));
}

void AddPoint(const char* heading,
              const Eigen::Vector3d& point,
              int first,
              const PivotResult& result,
              HtmlPage* page) {
  page->Heading(heading);
  HtmlTable table = {{{""},
                      {"value, mm", true},
                      {"standard uncertainty, mm", true},
                      {"expanded, p = 95 %, mm", true},
                      {"coverage factor k", true},
                      {"degrees of freedom", true}},
                     {}};
  for (int k = 0; k < 3; ++k) {
    const int row = first + k;
    const double dof = result.degrees_of_freedom[row];
    const auto number = [&](double value) {
      return IsDetermined(result, row) ? MilliText(value) : "not determined";
    };
    table.rows.push_back(
        {std::string(1, "xyz"[k]),
         MilliText(point[k]),
         number(std::sqrt(result.covariance(row, row))),
         number(result.half_width[row]),
         CoverageFactorText(result.half_width[row], std::sqrt(result.covariance(row, row))),
         std::isfinite(dof) ? fmt::format("{:.0f}", dof) : "∞"});
  }
  page->Table(table);
}

std::string FitSentence(const PivotResult& result) {
  const std::string value =
      fmt::format("Chi-square of what is left over: {:.5g} with {} degrees of freedom. ",
                  result.chi_square,
                  result.degrees_of_freedom_of_fit);
  if (!result.NoiseIsStated())
    return value + "The noise was estimated from it, so that there is nothing to test.";
  if (result.lost_count() > 0) return value + "With a tip that is not determined it is no test.";
  const bool is_large = result.chi_square > result.chi_square_high;
  return fmt::format("{}Expected with 95 %: {:.4g} to {:.4g}. {}",
                     value,
                     result.chi_square_low,
                     result.chi_square_high,
                     is_large ? "There is more than the stated noise explains: the tip slipped, "
                                "the tool bent, or the noise is larger."
                     : result.chi_square < result.chi_square_low
                         ? "There is less: the stated noise is too large, and so are the "
                           "uncertainties."
                         : "The residuals agree with the stated noise.");
}

void AddOutliers(const PivotResult& result, HtmlPage* page) {
  page->Heading("Readings that the others contradict");
  if (result.outliers.empty())
    return page->Paragraph("None (one clean pivoting in a hundred lists one).");
  HtmlTable table = {
      {{"reading"}, {"line", true}, {"off, mm", true}, {"sigmas", true}, {"p", true}, {"used"}},
      {}};
  for (const PivotOutlier& outlier : result.outliers) {
    const PivotRow& row = result.rows[outlier.index];
    table.rows.push_back({row.label,
                          row.line > 0 ? fmt::format("{}", row.line) : "",
                          MilliText(outlier.distance),
                          fmt::format("{:.1f}", outlier.sigmas),
                          ProbabilityText(outlier.p_value),
                          row.used ? "yes" : "left out"});
  }
  page->Table(table);
}

}  // namespace

std::string PivotHtml(const std::string& dataset,
                      const RunRecord& record,
                      const PivotPoses& poses,
                      const PivotOptions& options,
                      const PivotResult& result) {
  HtmlPage page("pivot",
                "Tool tip by pivoting: " + dataset,
                fmt::format("{} readings · where the tip is in the tool's frame, and how sure "
                            "that is",
                            result.rows.size()));
  AddVerdict(result, &page);
  page.Section("Results");
  AddPoint("The tip in frame T", result.x.tip_in_tool, 0, result, &page);
  AddPoint("The pivot in frame W", result.x.pivot_in_world, 3, result, &page);
  page.Note(
      "Expanded: k times the standard uncertainty; the truth lies within it with p = 95 %, each "
      "number by itself (Student's t). Frame T "
      "is that of the tool's markers, W that in which the poses are given.");
  page.Section("The motion");
  page.Figures({PivotSceneChart(poses, result), TiltChart(result, options)});
  page.Section("What is left over");
  page.Paragraph(FitSentence(result));
  page.Figures({PivotResidualChart(result), PivotSigmasChart(result)});
  AddOutliers(result, &page);
  AddReproduction(record, result.warnings, "pivot.json", &page);
  return page.Html();
}

}  // namespace hexcal
