// SPDX-License-Identifier: BSD-3-Clause
#include "report/calibrate_html.h"

#include <fmt/format.h>

#include "report/estimate_charts.h"
#include "report/estimate_sections.h"
#include "report/marker_charts.h"
#include "report/quantity.h"
#include "report/residual_section.h"

namespace hexcal {
namespace {

void AddVerdict(const Estimate& estimate, HtmlPage* page) {
  if (!estimate.converged)
    return page->Verdict(Tone::kBad, "verdict", "not converged", estimate.message);
  if (!estimate.IsTrustworthy())
    return page->Verdict(Tone::kBad,
                         "verdict",
                         "not determined",
                         "The poses do not determine all 12 parameters: " +
                             estimate.observability.weak_directions[0] + ".");
  page->Verdict(Tone::kGood,
                "verdict",
                "calibrated",
                fmt::format("Base and tool are determined; {} and {} RMS are left over.",
                            SizeText(estimate.rmspe, "m"),
                            SizeText(estimate.rmsoe, "rad")));
}

void AddFit(const ResultHeader& header,
            const Estimate& estimate,
            const Scene& scene,
            const LeftOver& left,
            HtmlPage* page) {
  page->Section("What is left over");
  page->Paragraph(
      fmt::format("Chi-square {:.5g} with {} degrees of freedom, noise scale {:.3f}; noise of a "
                  "measured pose {} and {} a coordinate, {}.",
                  estimate.chi_square,
                  estimate.degrees_of_freedom,
                  estimate.noise_scale,
                  SizeText(estimate.noise.position, "m"),
                  SizeText(estimate.noise.orientation, "rad"),
                  estimate.noise.estimated ? "estimated from it" : "as stated"));
  if (estimate.least_squares)
    page->Paragraph(fmt::format(
        "That is the sum as this fit weighs the poses. Least squares leaves {:.5g} of the same "
        "poses, none weighted down, with {} degrees of freedom, noise scale {:.3f}: the noise is "
        "judged by it.",
        estimate.least_squares->chi_square,
        estimate.least_squares->degrees_of_freedom,
        estimate.least_squares->Scale()));
  AddResidualPictures(left.poses, scene, page);
  AddMarkers(left, page);
  page->Heading("How the fit was found");
  page->Figure(ConvergenceChart(estimate.iterations, header.solver + " solver"));
  if (estimate.outliers.empty()) return;
  page->Heading("Poses that the others contradict");
  HtmlTable table = {{{"pose"}, {"why"}, {"p", true}, {"used"}}, {}};
  for (const Outlier& outlier : estimate.outliers)
    table.rows.push_back({outlier.label,
                          outlier.reason,
                          ProbabilityText(outlier.p_value),
                          estimate.poses[outlier.index].weight > 0.0 ? "yes" : "left out"});
  page->Table(table);
}

}  // namespace

std::string CalibrateHtml(const ResultHeader& header,
                          const RunRecord& record,
                          const Estimate& estimate,
                          const FrameGraph& frames,
                          const Scene& scene,
                          const LeftOver& left) {
  HtmlPage page("calibrate",
                "Calibration: " + header.dataset,
                fmt::format("{} poses · where base and tool are, and how sure that is",
                            estimate.poses.size()));
  AddVerdict(estimate, &page);
  AddMounts(estimate, &page);
  page.Section("Frames");
  page.Figure(FrameGraphDrawing(frames));
  AddFit(header, estimate, scene, left, &page);
  AddReproduction(record, estimate.warnings, "result.json and model.yaml", &page);
  return page.Html();
}

}  // namespace hexcal
