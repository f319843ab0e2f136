// SPDX-License-Identifier: BSD-3-Clause
#include "report/budget_charts.h"

#include <fmt/format.h>

#include "report/chart_parts.h"
#include "report/html/escape.h"

namespace hexcal {

using Json = nlohmann::ordered_json;

Chart BudgetChart(const PointReport& report) {
  Chart chart;
  chart.title = fmt::format("What the error of {} is made of", report.point.name);
  chart.shows =
      "the part of the variance that each source has where the error is worst in the workspace.";
  chart.good = "no single surprise: the longest bar is where better work pays.";
  Json names = Json::array(), shares = Json::array(), sizes = Json::array();
  for (const BudgetRow& row : report.budget.rows) {
    names.push_back(EscapeLabel(LabelOf(row)));
    shares.push_back(100.0 * row.share);
    sizes.push_back(fmt::format("{:.4f} mm", 1e3 * row.contribution));
  }
  chart.data = Json::array({{{"type", "bar"},
                             {"orientation", "h"},
                             {"y", names},
                             {"x", shares},
                             {"text", sizes},
                             {"textposition", "none"},  // for narrow screens
                             {"hovertemplate", "%{y}: %{x:.3g} %, %{text}<extra></extra>"},
                             {"marker", {{"color", "@after"}}}}});
  Json y = OpenAxis("");
  y["autorange"] = "reversed";
  Json x = Axis("% of the variance", true);
  chart.layout = {{"height", 130 + 34 * static_cast<int>(report.budget.rows.size())},
                  {"xaxis", x},
                  {"yaxis", y}};
  return chart;
}

}  // namespace hexcal
