// SPDX-License-Identifier: BSD-3-Clause
#include "report/budget_charts.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "report/chart_parts.h"

namespace hexcal {

using Json = nlohmann::ordered_json;

Chart BudgetChart(const PointReport& report) {
  Chart chart;
  chart.title = fmt::format("What the error of {} is made of", report.point.name);
  chart.shows =
      "the part of the variance that each source has where the error is worst in the workspace.";
  chart.good = "no single surprise: the longest bar is where better work pays.";
  std::vector<std::string> names;
  Json shares = Json::array(), sizes = Json::array();
  for (const BudgetRow& row : report.budget.rows) {
    names.push_back(LabelOf(row));
    shares.push_back(100.0 * row.share);
    sizes.push_back(fmt::format("{:.4f} mm", 1e3 * row.contribution));
  }
  Json bars = NamedBars(names, shares, "%{x:.3g} %, %{customdata}", &chart);
  bars["customdata"] = sizes;
  chart.data = Json::array({bars});
  chart.layout["xaxis"] = Axis("% of the variance", true);
  return chart;
}

}  // namespace hexcal
