// SPDX-License-Identifier: BSD-3-Clause
#include "report/compare_html.h"

#include <fmt/format.h>

#include "report/chart_parts.h"
#include "report/comparison_sections.h"
#include "report/estimate_charts.h"
#include "report/estimate_sections.h"
#include "report/marker_charts.h"
#include "report/quantity.h"
#include "report/residual_section.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

// Starts that arrive, by how far off they were.
Chart ArrivalChart(const ConvergenceMap& map, const char* iteration) {
  Chart chart;
  chart.title = fmt::format("From where {} arrives", iteration);
  chart.shows =
      "the share of starts that arrive at the solution, by how far both mounts were turned (up) "
      "and "
      "moved (to the right) from it.";
  chart.good = "full colour wherever a first guess may be.";
  chart.table = {{{"turned by"}}, {}};
  Json x = Json::array(), y = Json::array(), z = Json::array();
  for (const double move : map.translation_errors) {
    x.push_back(SizeText(move, "m"));
    chart.table.columns.push_back({"moved by " + SizeText(move, "m"), true});
  }
  for (std::size_t i = 0; i < map.rotation_errors.size(); ++i) {
    y.push_back(SizeText(map.rotation_errors[i], "rad"));
    std::vector<std::string> row = {SizeText(map.rotation_errors[i], "rad")};
    Json shares = Json::array();
    for (const double share : map.share[i]) {
      shares.push_back(100.0 * share);
      row.push_back(ShareText(share));
    }
    z.push_back(shares);
    chart.table.rows.push_back(row);
  }
  Json scale = Json::array({Json::array({0.0, "@middle"}), Json::array({1.0, "@after"})});
  chart.data = Json::array({{{"type", "heatmap"},
                             {"x", x},
                             {"y", y},
                             {"z", z},
                             {"zmin", 0},
                             {"zmax", 100},
                             {"colorscale", scale},
                             {"colorbar", {{"title", {{"text", "%"}}}, {"thickness", 12}}}}});
  Json across = OpenAxis("moved by"), up = OpenAxis("turned by");
  across["type"] = up["type"] = "category";
  chart.layout = {{"height", 360}, {"xaxis", across}, {"yaxis", up}};
  return chart;
}

void AddMaps(const Comparison& comparison, HtmlPage* page) {
  std::vector<Chart> charts;
  if (!comparison.paper_map.share.empty())
    charts.push_back(ArrivalChart(comparison.paper_map, "the paper's iteration"));
  if (!comparison.twist_map.share.empty())
    charts.push_back(ArrivalChart(comparison.twist_map, "the twist iteration"));
  if (charts.empty()) return;
  page->Section("From which starts the iterations arrive");
  page->Figures(charts);
}

}  // namespace

std::string CompareHtml(const std::string& dataset,
                        const RunRecord& record,
                        const Comparison& comparison,
                        const Scene& scene,
                        const LeftOver& left) {
  const Estimate& reference = comparison.reference;
  const Certificate& certificate = comparison.certificate;
  HtmlPage page("compare",
                "Methods compared: " + dataset,
                fmt::format("{} poses · the linearized iterations, the closed forms and the "
                            "nonlinear solution side by side",
                            reference.poses.size()));
  page.Verdict(!reference.IsTrustworthy() ? Tone::kBad
               : certificate.certified    ? Tone::kGood
                                          : Tone::kWarn,
               "verdict",
               !certificate.certified ? "not certified"
               : certificate.exact    ? "certified"
                                      : "certified for even weights",
               (certificate.exact
                    ? "Of the nonlinear solution, with its own weights: "
                    : "Certificates exist for poses that count evenly: one weight for all "
                      "coordinates and one for all angles. The weights of the solution on this "
                      "page differ by axis or pose, so that the certificate is of these poses with "
                      "even weights, not of that solution itself: ") +
                   certificate.why + ".");
  page.Section("The methods");
  AddMethods(comparison, &page);
  AddMaps(comparison, &page);
  page.Section("The nonlinear solution");
  AddPropagation(comparison.propagation, &page);
  AddMounts(reference, &page);
  page.Section("What it leaves over");
  AddResidualPictures(left.poses, scene, &page);
  AddMarkers(left, &page);
  AddReproduction(record, reference.warnings, "compare.json", &page);
  return page.Html();
}

}  // namespace hexcal
