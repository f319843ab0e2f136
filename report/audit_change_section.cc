// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "report/audit_sections.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

std::string TestText(const Change& change) {
  if (change.shared.poses > 0) return "";
  if (change.is_of_exact) return fmt::format("Not tested: {}.", kOfExactData);
  if (!std::isfinite(change.chi_square)) return "Not all 12 parameters are determined in both.";
  return fmt::format(
      "All 12 together: chi-square {:.4g}, of 12 degrees of freedom; by chance it is as large with "
      "a probability of {}.",
      change.chi_square,
      ProbabilityText(change.p_value));
}

}  // namespace

void AddChange(const Audit& audit, HtmlPage* page) {
  if (!audit.change) return;
  const Change& change = *audit.change;
  const bool is_tested = change.IsTested();
  page->Section("Change since an earlier calibration");
  page->Paragraph(fmt::format("Earlier: {} (dataset {}). {}",
                              change.earlier.path,
                              change.earlier.dataset,
                              TestText(change)));
  page->Paragraph(WordsOf(change.shared));
  HtmlTable table = {{{"parameter"},
                      {"change", true},
                      {is_tested ? "in its standard uncertainties"
                                 : "in the standard uncertainties of now, a size and no test",
                       true}},
                     {}};
  const Vector12d& sigmas = is_tested ? change.sigmas : change.over_own;
  for (int i = 0; i < 12; ++i)
    table.rows.push_back(
        {std::string(kParameters[i].name),
         fmt::format(
             "{:.4f} {}", 1e3 * change.difference[i], kParameters[i].is_angle ? "mrad" : "mm"),
         std::isfinite(sigmas[i]) ? fmt::format("{:.2f}", sigmas[i]) : "–"});
  page->Table(table);
  HtmlTable points = {
      {{"point, at the centre of the workspace"}, {"has moved, mm", true}, {"u of it, mm", true}},
      {}};
  for (std::size_t i = 0; i < change.at_points.size(); ++i)
    points.rows.push_back({audit.requirements.points[i].name,
                           MilliText(change.at_points[i]),
                           MilliText(change.sigma_at_points[i])});
  page->Table(points);
  page->Note(
      "u: by both calibrations, along the way that the point has moved; a length is never below "
      "zero, so that one of about u or less says no more than that none was found. A dash where "
      "nothing is tested.");
}

}  // namespace hexcal
