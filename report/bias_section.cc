// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "report/audit_sections.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr int kCycles = 30;  // of ISO 9283

void AddRepeated(const Audit& audit, HtmlPage* page) {
  HtmlTable table = {{{"point"},
                      {"repeated poses", true},
                      {"visits of each, at least", true},
                      {"pose accuracy AP, mm", true},
                      {"repeatability RP, mm", true}},
                     {}};
  for (const PointReport& report : audit.points)
    if (const auto& repeated = report.validation.repeated)
      table.rows.push_back({report.point.name,
                            fmt::format("{}", repeated->poses),
                            fmt::format("{}", repeated->fewest),
                            MilliText(repeated->accuracy),
                            MilliText(repeated->repeatability)});
  if (table.rows.empty())
    return page->Paragraph(
        "Pose accuracy and repeatability in the manner of ISO 9283 are not given: no reported pose "
        "was measured twice.");
  page->Table(table);
  page->Note(fmt::format(
      "In the manner of ISO 9283:1998, of the worst of the repeated poses, with the tracker's "
      "noise in them. Not held out: AP is from where the calibration that used these poses, too, "
      "predicts them, and so a little small. The standard asks for five poses in a cube, {} cycles "
      "each; nothing here "
      "claims to be that.",
      kCycles));
}

}  // namespace

void AddBias(const Audit& audit, HtmlPage* page) {
  if (audit.points.empty() || audit.points[0].validation.poses < 2) return;
  page->Heading("Bias and precision at the named points");
  HtmlTable table = {{{"point"},
                      {"axis of W"},
                      {"bias, mm", true},
                      {"its u, mm", true},
                      {"precision, mm", true},
                      {"RMS length, mm", true}},
                     {}};
  for (const PointReport& report : audit.points) {
    const PointValidation& validation = report.validation;
    const Eigen::Vector3d u = validation.BiasUncertainty();
    for (int k = 0; k < 3; ++k)
      table.rows.push_back({k == 0 ? report.point.name : "",
                            std::string(1, "xyz"[k]),
                            MilliText(validation.bias[k]),
                            MilliText(u[k]),
                            MilliText(validation.precision[k]),
                            k == 0 ? MilliText(validation.rms) : ""});
  }
  page->Table(table);
  page->Note(
      "Of the poses held out, each predicted from the others: bias is the mean of measured minus "
      "predicted, precision the standard deviation about it, u that of the bias. In the words of "
      "ASTM F2554 accuracy is both together; the error of the measurement itself is in both. A "
      "bias "
      "that the calibration shares with all poses cannot show here: for that the points must be "
      "measured by other means.");
  AddRepeated(audit, page);
}

}  // namespace hexcal
