// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "report/audit_sections.h"

namespace hexcal {
namespace {

std::string ReasonsText(const RowCount& count) {
  std::string text;
  for (const auto& [code, number] : count.reasons)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", code, number);
  return text;
}

}  // namespace

void AddRowCounts(const Audit& audit, HtmlPage* page) {
  page->Heading("What became of every row");
  HtmlTable table = {{{"input"},
                      {"given", true},
                      {"used", true},
                      {"missing", true},
                      {"rejected", true},
                      {"why, with how many"}},
                     {}};
  for (const RowCount& count : audit.rows)
    table.rows.push_back({count.input,
                          fmt::format("{}", count.given),
                          fmt::format("{}", count.used),
                          fmt::format("{}", count.missing),
                          fmt::format("{}", count.rejected),
                          ReasonsText(count)});
  page->Table(table);
  page->Note(
      "Missing: no_reading, a pose that was not measured; not_seen, a row without coordinates; "
      "no_row, a frame that has rows of other markers and none of this one. Rejected: "
      "too_few_markers, collinear_markers, of a body in that pose; no_weight, an outlier or what "
      "the loss gives no weight. Missing rows of kind no_row are not among those given.");
}

void AddPoseDesign(const Audit& audit, HtmlPage* page) {
  page->Section("Poses that were measured");
  const PoseDesign& design = audit.design;
  page->Paragraph(fmt::format(
      "{} poses; rotations about the mean orientation are {:.2f}°, {:.2f}° and {:.2f}° RMS about "
      "their three main axes, and the axes of the larger half of them are up to {:.0f}° apart.",
      design.poses.size(),
      design.rotation_rms[0] * 180.0 / kPi,
      design.rotation_rms[1] * 180.0 / kPi,
      design.rotation_rms[2] * 180.0 / kPi,
      design.angle_between_axes * 180.0 / kPi));
  page->Figures(PoseDesignCharts(design, audit.workspace));
}

}  // namespace hexcal
