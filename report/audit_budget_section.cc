// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "report/audit_sections.h"
#include "report/budget_charts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

std::string FreedomText(double degrees_of_freedom) {
  return std::isfinite(degrees_of_freedom) ? fmt::format("{:.0f}", degrees_of_freedom) : "∞";
}

std::string_view SpreadText(BudgetSpread spread) {
  return spread == BudgetSpread::kStudent ? "Student's t" : NameOf(spread);
}

// mm for lengths, mrad for angles, so that a row can be multiplied out as it stands.
std::string ValueText(const BudgetRow& row) {
  return fmt::format(
      "{:.5f} {}", 1e3 * row.value, row.quantity == BudgetQuantity::kOrientation ? "mrad" : "mm");
}

std::string SensitivityText(const BudgetRow& row) {
  return row.quantity == BudgetQuantity::kOrientation
             ? fmt::format("{:.4f} mm/mrad", row.sensitivity)
             : fmt::format("{:.4f}", row.sensitivity);
}

HtmlTable SourceTable(const PointReport& report) {
  HtmlTable table = {{{"source"},
                      {"value from"},
                      {"type"},
                      {"value", true},
                      {"distribution"},
                      {"divisor", true},
                      {"sensitivity", true},
                      {"RMS, mm", true},
                      {"share", true},
                      {"ν", true}},
                     {}};
  for (const BudgetRow& row : report.budget.rows)
    table.rows.push_back({LabelOf(row),
                          row.origin,
                          std::string(1, row.type),
                          ValueText(row),
                          std::string(SpreadText(row.spread)),
                          row.divisor == 1.0 ? "1" : "√3",
                          SensitivityText(row),
                          fmt::format("{:.5f}", 1e3 * row.contribution),
                          ShareText(row.share),
                          FreedomText(row.degrees_of_freedom)});
  table.rows.push_back({"combined (RMS)",
                        "root of the sum of squares",
                        "",
                        "",
                        "",
                        "",
                        "",
                        fmt::format("{:.5f}", 1e3 * report.worst.rms),
                        "100 %",
                        FreedomText(report.worst.degrees_of_freedom)});
  table.chosen_row = static_cast<int>(table.rows.size()) - 1;
  return table;
}

HtmlTable ParameterTable(const Budget& budget) {
  HtmlTable table = {{{"number"},
                      {"standard uncertainty", true},
                      {"sensitivity", true},
                      {"RMS, mm", true},
                      {"share", true},
                      {"ν", true}},
                     {}};
  for (const ParameterRow& row : budget.parameters) {
    const DisplayUnit unit = DisplayUnitOf(row.unit);
    const std::string name = unit.name == "1" ? "" : " " + unit.name;
    table.rows.push_back(
        {row.name,
         fmt::format("{:.5g}{}", unit.factor * row.value, name),
         fmt::format("{:.5g} mm/{}", 1e3 * row.sensitivity / unit.factor, unit.name),
         fmt::format("{:.5f}", 1e3 * row.contribution),
         ShareText(row.share),
         FreedomText(row.degrees_of_freedom)});
  }
  table.rows.push_back(
      {"their correlations", "", "", "", fmt::format("{:.0f} %", 100.0 * budget.correlations), ""});
  return table;
}

}  // namespace

void AddBudget(const Audit& audit, HtmlPage* page) {
  page->Section("Uncertainty budget");
  page->Paragraph(
      "The error of a point is made of the calibration's, carried to the point by J Σ Jᵀ, and of "
      "those that the machine has wherever it is used. Contributions are RMS lengths where the "
      "error is worst in the workspace: sensitivity × value / divisor; their shares are of the "
      "variance, ν their degrees of freedom.");
  if (!audit.robot_is_stated)
    page->Paragraph(
        "Nothing is stated of the robot's own error; it is NOT in this budget, and no requirement "
        "passes without it.");
  std::vector<Chart> charts;
  for (const PointReport& report : audit.points) {
    page->Heading(report.point.name);
    page->Table(SourceTable(report));
    page->Heading(fmt::format("{}: the calibration's part, number by number", report.point.name));
    page->Table(ParameterTable(report.budget));
    charts.push_back(BudgetChart(report));
  }
  page->Figures(charts);
  page->Note(
      "Value: a standard deviation of each coordinate (normal, Student's t), or the half width of "
      "an interval (rectangular: what was stated as a standard deviation, times √3). Sensitivity: "
      "the RMS length that one unit about or along each of three axes makes: √3 for a position, √2 "
      "times the distance from the point to where the rotation acts for an orientation, 1 for a "
      "length. The calibration's numbers are small motions along and about a mount's own axes; "
      "their errors are correlated, so that their squares do not add up to the variance without "
      "the last row (JCGM 100:2008, 5.2.2).");
  page->Note(
      "Type A: evaluated by statistics of observations; type B: otherwise (JCGM 100:2008). The "
      "calibration, and a point by pivoting, is of type A where its noise was told by what is left "
      "over, of type B where the noise was stated. Degrees of freedom of the sum: Welch and "
      "Satterthwaite, by traces.");
}

}  // namespace hexcal
