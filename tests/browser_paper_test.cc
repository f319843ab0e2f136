// SPDX-License-Identifier: BSD-3-Clause
// Pictures as they are drawn anew for paper, lower than on a screen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "report/chart_parts.h"
#include "report/html/assets.h"
#include "testing/browser.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

// Makes the page ready for paper and writes which names lie on bars.
constexpr char kLook[] = R"(
function boxes(page, what) {
  return Array.from(page.querySelectorAll(what)).map(e => e.getBoundingClientRect());
}
function look() {
  const frame = document.getElementById("framed"), page = frame.contentDocument;
  if (!page || !page.documentElement.dataset.complete) return window.setTimeout(look, 100);
  frame.contentWindow.dispatchEvent(new Event("beforeprint"));
  const bars = boxes(page, ".bars .point path"), names = boxes(page, ".annotation-text-g");
  const on = names.filter(a => bars.some(b =>
    Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 &&
    Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1));
  const found = document.createElement("p");
  found.textContent = "of " + names.length + " names " + on.length + " on " + bars.length + " bars";
  document.body.appendChild(found);
}
look();
)";

class OnPaper : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
    if (FlatCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  }
  std::string Look(const Chart& chart) {
    HtmlPage page("test", "t", "s");
    page.Figure(chart);
    const std::string dom = browser.FramedDom(page.Html(), 1000, kLook);
    return dom.substr(std::min(dom.size(), dom.rfind("<p>")));
  }
  testing::Browser browser;
};

TEST_P(OnPaper, NamesStandClearOfTheBars) {
  const int count = GetParam();
  Json lengths = Json::array();
  for (int i = 0; i < count; ++i) lengths.push_back(100 - i);
  Chart chart;
  chart.data =
      Json::array({NamedBars(std::vector<std::string>(count, "a name"), lengths, "%{x}", &chart)});
  const std::string of = "<p>of " + std::to_string(count) + " names ";
  EXPECT_THAT(Look(chart), HasSubstr(of + "0 on " + std::to_string(count) + " bars</p>"));
  chart.has_rows = false;  // as low as a curve may be
  EXPECT_THAT(Look(chart), Not(HasSubstr(of + "0 on ")));
}
INSTANTIATE_TEST_SUITE_P(Of, OnPaper, ::testing::Values(2, 4, 12));

}  // namespace
}  // namespace hexcal
