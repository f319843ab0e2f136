// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "report/accuracy_charts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr const char* kNumbers[6] = {"x, mm", "y, mm", "z, mm", "rx, mrad", "ry, mrad", "rz, mrad"};

}  // namespace

void AddAccuracy(const Audit& audit, HtmlPage* page) {
  page->Section("Accuracy over the workspace");
  HtmlTable box = {{{"T_A^B, Eq. (2)"}, {"from", true}, {"to", true}}, {}};
  const auto text = [&](int number, int end) {
    const double stated = audit.workspace.box[number][end];
    const double value = IsRounding(stated) ? 0.0 : stated;
    return number < 3 ? fmt::format("{:.4g}", 1e3 * value)
                      : fmt::format("{:.4g} ({:.4g}°)", 1e3 * value, value * 180.0 / kPi);
  };
  for (int i = 0; i < 6; ++i) box.rows.push_back({kNumbers[i], text(i, 0), text(i, 1)});
  page->Table(box);
  page->Note(fmt::format(
      "{} {} places of a grid over it {}{}.",
      audit.workspace.is_stated ? "As the requirement file has it." : "What the poses span.",
      audit.places,
      audit.points.empty() ? "would be looked at" : "were looked at",
      audit.workspace.IsMeasured()
          ? ""
          : fmt::format("; it reaches beyond all poses that were measured, in {}: nothing but the "
                        "model speaks there",
                        BeyondPoses(audit.workspace))));
  if (audit.points.empty())
    return page->Paragraph(
        audit.places == 0
            ? "Nothing is said of a place: none of them is one that the model reaches."
            : "Nothing is said of a place: the poses do not determine base and tool, or the fit "
              "has not converged.");
  HtmlTable table = {{{"point"},
                      {"where"},
                      {"RMS, mm", true},
                      {"not exceeded with p = 95 %, mm", true},
                      {"k", true},
                      {"degrees of freedom", true}},
                     {}};
  std::vector<std::string> places;
  for (const PointReport& report : audit.points) {
    for (const auto& [name, at] :
         {std::pair{"centre", &report.centre}, std::pair{"worst", &report.worst}})
      table.rows.push_back({report.point.name,
                            name,
                            MilliText(at->rms),
                            MilliText(at->length_95),
                            CoverageFactorText(at->length_95, at->rms),
                            std::isfinite(at->degrees_of_freedom)
                                ? fmt::format("{:.0f}", at->degrees_of_freedom)
                                : "∞"});
    places.push_back(
        fmt::format("{}: worst at {}", report.point.name, WordsOf(report.worst.place)));
  }
  page->Table(table);
  page->Note(
      "k: the length that is not exceeded over the RMS. It lies between 1.614 (an error alike "
      "along "
      "all axes) and 1.960 (along one alone) where the degrees of freedom are many.");
  page->List(places);
  for (const PointReport& report : audit.points) page->Figure(MapChart(report));
}

}  // namespace hexcal
