// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "report/audit_sections.h"
#include "report/estimate_charts.h"
#include "report/marker_charts.h"
#include "report/quantity.h"
#include "report/residual_section.h"

namespace hexcal {
namespace {

// Of each pose that the others check, whether the fit used it.
std::vector<bool> UsedPosesOf(const Audit& audit) {
  const PoseResiduals& residuals = audit.left_over.poses;
  std::set<std::string> left_out;
  for (std::size_t i = 0; i < residuals.labels.size(); ++i)
    if (!residuals.used[i]) left_out.insert(residuals.labels[i]);
  std::vector<bool> used;
  for (const PoseCheck& pose : audit.poses) used.push_back(left_out.count(pose.label) == 0);
  return used;
}

void AddOutliers(const Audit& audit, HtmlPage* page) {
  page->Heading("Outliers");
  const Estimate& estimate = audit.estimate;
  const bool is_rounding = audit.global.is_rounding;
  if (is_rounding)
    page->Paragraph("Neither poses nor readings are tested: " + std::string(kOnlyRounding) + ".");
  else if (estimate.outliers.empty())
    page->Paragraph("No pose contradicts the others (at 1 % for all poses together).");
  HtmlTable table = {{{"pose"}, {"why"}, {"p", true}, {"used"}}, {}};
  for (const Outlier& outlier : estimate.outliers) {
    const bool is_used = estimate.poses[outlier.index].weight > 0.0;
    table.rows.push_back({outlier.label,
                          outlier.reason,
                          ProbabilityText(outlier.p_value),
                          is_used ? "yes" : "left out"});
  }
  if (!table.rows.empty()) page->Table(table);
  if (is_rounding) return;
  if (!audit.poses.empty()) page->Figure(SmallestChart(audit.poses, UsedPosesOf(audit)));
  if (audit.readings) return AddReadings(*audit.readings, page);
  if (audit.grown)
    page->Note("With effects of a model poses are tested as a whole, single marker readings not.");
}

std::ptrdiff_t CountLeftOut(const Estimate& estimate) {
  return std::count_if(estimate.poses.begin(), estimate.poses.end(), [](const PoseResult& pose) {
    return !(pose.weight > 0.0);
  });
}

HtmlTable BodyTable(const Audit& audit) {
  HtmlTable table = {{{"body"},
                      {"markers", true},
                      {"noise of a reading, mm", true},
                      {"misfit of the markers that it makes (FRE), mm", true}},
                     {}};
  for (const NamedPoint& point : audit.requirements.points)
    table.columns.push_back({fmt::format("error at {} (TRE), mm", point.name), true});
  for (const BodyReport& body : audit.bodies) {
    std::vector<std::string> row = {body.name,
                                    fmt::format("{}", body.markers),
                                    MilliText(body.sigma),
                                    MilliText(body.fiducial)};
    for (std::size_t i = 0; i < audit.requirements.points.size(); ++i)
      row.push_back(body.at_points.empty() ? "" : MilliText(body.at_points[i]));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

void AddGoodnessOfFit(const Audit& audit, HtmlPage* page) {
  page->Section("Goodness of fit");
  const Estimate& estimate = audit.estimate;
  page->Paragraph(GlobalTestText(audit.global, audit.header, estimate));
  page->Paragraph(fmt::format("RMS of what is left over: {} and {} (RMSPE, RMSOE).",
                              SizeText(estimate.rmspe, "m"),
                              SizeText(estimate.rmsoe, "rad")));
  page->Note(
      "A good fit alone says little about the error of a point of the tool: that is in the "
      "sections "
      "on the budget and on the workspace.");
  if (CountLeftOut(estimate) > 0)
    page->Note(
        "Poses that were left out are in the pictures pose by pose, as crosses, and in the "
        "map of the legs; no "
        "figure (chi-square, RMS, a marker's mean, held-out poses) has them in it" +
        std::string(audit.header.loss.kind == LossKind::kNone
                        ? "."
                        : ", but for the chi-square that is tested under a loss: what the loss "
                          "weighs down, to nothing too, is there in full, since it is not noise as "
                          "stated. Poses that were rejected are not."));
  AddResidualPictures(audit.left_over.poses, audit.scene, page);
  AddMarkers(audit.left_over, page);
  AddOutliers(audit, page);
  if (audit.bodies.empty()) return;
  page->Heading("What one reading of the markers is worth");
  page->Table(BodyTable(audit));
  page->Note(
      "RMS, for markers that are read with the same noise along all axes (Fitzpatrick, West and "
      "Maurer 1998). The misfit of the markers does not tell the error elsewhere.");
}

void AddValidation(const Audit& audit, HtmlPage* page) {
  page->Section("Validation on held-out poses");
  const HeldOutTest& held = audit.held_out;
  if (held.poses == 0) return page->Paragraph("There is nothing to validate with.");
  if (audit.global.is_rounding)
    return page->Paragraph("Not validated: " + std::string(kOnlyRounding) + ".");
  page->Paragraph(fmt::format(
      "Each pose was predicted from all the others: {} RMS where noise and prediction "
      "explain {}, and "
      "{} where they explain {}. {} of {} poses lie within the 95 % region of their "
      "prediction; {}.",
      SizeText(held.rms_position, "m"),
      SizeText(held.expected_position, "m"),
      SizeText(held.rms_orientation, "rad"),
      SizeText(held.expected_orientation, "rad"),
      held.inside,
      held.poses,
      held.fewest > 0 ? fmt::format("of a model that lacks nothing it would be {} or more in 99 of "
                                    "100 cases",
                                    held.fewest)
                      : "so few poses depend on each other too much for a test of that number"));
  if (audit.comparison.folds > 0)
    page->Note(fmt::format(
        "One pose at a time; the figures by method, in the section on linearized against "
        "nonlinear, leave out one of {} parts of the poses at a time, and differ a little for it.",
        audit.comparison.folds));
  if (audit.header.loss.kind != LossKind::kNone)
    page->Note(
        "The others weigh as in the fit. A pose that the loss weighs down counts here in full, one "
        "to which it gives no weight not at all.");
  if (audit.header.error == "paper")
    page->Note("What a pose has moved the fit by is reckoned as of weights by the noise.");
  const auto left_out = CountLeftOut(audit.estimate);
  if (left_out > 0)
    page->Paragraph(fmt::format(
        "{} left out of the fit, predict{} nothing and {} not among those {}; the picture has {}.",
        left_out == 1 ? "A pose was" : fmt::format("{} poses were", left_out),
        left_out == 1 ? "s" : "",
        left_out == 1 ? "is" : "are",
        held.poses,
        left_out == 1 ? "it" : "them"));
  page->Paragraph(
      fmt::format("Coverage of the 95 % regions: {}, the share that was achieved and the 95 % "
                  "limits of its probability that so many poses confirm (binomial, Clopper and "
                  "Pearson). {}",
                  CoverageText(*held.coverage),
                  held.coverage->HoldsNominal()
                      ? "95 % is among them."
                      : "95 % is not among them: noise or model are not what they are taken for."));
  page->Figure(HeldOutChart(audit.poses, UsedPosesOf(audit)));
  AddBias(audit, page);
}

}  // namespace hexcal
