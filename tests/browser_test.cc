// SPDX-License-Identifier: BSD-3-Clause
// Reports in a real browser, offline: pictures are drawn, nothing is said on the console (errors,
// refusals by the policy, requests), hostile names do nothing, the page prints.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/chart_parts.h"
#include "report/discovery_html.h"
#include "report/discovery_json.h"
#include "report/html/assets.h"
#include "report/html/page.h"
#include "testing/browser.h"
#include "testing/discoveries.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

RunRecord Record() {
  RunRecord record;
  record.version = "hexcal 1.2.3\n";
  record.settings = {{"seed", "7"}};
  record.inputs = {"dataset.yaml"};
  return record;
}

std::string Html(const Discovery& discovery, const RunRecord& record = Record()) {
  const Dataset dataset = testing::DatasetOf(discovery);
  return DiscoveryHtml(
      "demo", record, discovery, MakeScene(dataset, discovery), ResidualsOf(dataset, discovery));
}

// Drawing in software is slow, and said to be; nothing else is said.
void ExpectQuiet(const std::vector<std::string>& console) {
  for (const std::string& line : console)
    EXPECT_THAT(line, AnyOf(HasSubstr("Performance"), HasSubstr("willReadFrequently")));
}

class InBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
  }

  // Draws what there is to draw, without a word on the console.
  std::string Dom(const std::string& html) {
    std::string dom = browser.Dom(html);
    ExpectQuiet(browser.Console());
    if (!FlatCharts().empty()) {
      EXPECT_THAT(dom, HasSubstr("data-complete="));
    }
    // The libraries stand behind the page and have tags in their texts.
    return dom.substr(0, dom.find("plotly.js (cartesian"));
  }

  testing::Browser browser;
};

TEST_F(InBrowser, TheConsoleIsHeard) {
  browser.Dom("<script>console.error('heard')</script>");
  ASSERT_EQ(browser.Console().size(), 1u);
  EXPECT_THAT(browser.Console()[0], HasSubstr("heard"));
}

// A page's policy allows no request at all, and what it refuses is told.
TEST_F(InBrowser, ARequestWouldBeHeard) {
  std::string html = HtmlPage("test", "t", "s").Html();
  html.insert(html.find("</body>"), "<img src=\"https://example.com/a.png\">");
  browser.Dom(html);
  ASSERT_EQ(browser.Console().size(), 1u);
  EXPECT_THAT(browser.Console()[0], HasSubstr("violates the following Content Security Policy"));
}

TEST_F(InBrowser, ADiscoveryIsDrawnAndSaysWhatItsJsonSays) {
  const Discovery discovery = testing::MakeDiscovery();
  const std::string html = Html(discovery);
  const std::string dom = Dom(html);
  const int pictures = Count(html, "class=\"plot\"");
  EXPECT_EQ(pictures, FlatCharts().empty() ? 0 : 23);
  EXPECT_EQ(Count(dom, "class=\"plot js-plotly-plot\""), pictures);
  EXPECT_GE(Count(dom, "<svg class=\"main-svg\""), pictures - 2);
  EXPECT_LT(html.size(), std::size_t{8} << 20);
  for (const char* title : {"Position residuals over time",
                            "The machine, and where the tool was",
                            "What is left over, where the tool was",
                            "Residuals in standard deviations of the noise",
                            "Residuals against those of a normal sample (Q-Q)",
                            "Likeness of neighbours in the order of visit",
                            "Leg residuals against leg length",
                            "Map of the legs",
                            "How the fit of base, tool and effects arrived"})
    EXPECT_EQ(Count(dom, std::string("role=\"img\" aria-label=\"") + title) > 0, pictures > 0)
        << title;
  const auto json = nlohmann::json::parse(DiscoveryJson("demo", {}, discovery));
  EXPECT_THAT(dom, HasSubstr("id=\"verdict\"><strong>" + json["verdict"].get<std::string>()));
  for (const char* text : {"leg_gain — leg 3",
                           "312 ± 12 ppm",
                           "tool/t2 y",
                           "base_radius",
                           "other heights",
                           "leg_thermal",
                           "a temperature column",
                           "leg_backlash (2)",
                           "hexcal 1.2.3",
                           "dataset.yaml",
                           "a warning"})
    EXPECT_THAT(dom, HasSubstr(text));
}

TEST_F(InBrowser, WhereNothingWasFoundAndNoLegsAreKnownThereIsAPageToo) {
  Discovery discovery = testing::MakeDiscovery();
  discovery.verdict = Verdict::kUndecided;
  discovery.effects.clear();
  discovery.steps.erase(discovery.steps.begin(), discovery.steps.end() - 1);
  discovery.gap.heldout_before = discovery.gap.heldout_after = {};
  for (PoseGap& pose : discovery.poses) pose.leg_lengths.reset();
  EXPECT_THAT(Dom(Html(discovery)),
              AllOf(HasSubstr("<strong>undecided</strong>"), HasSubstr("geometry is not known")));
}

TEST_F(InBrowser, HostileNamesAreOnlyNames) {
  const std::string hostile =
      "</script><script>document.title='no'</script><img src=x onerror=\"document.title='no'\">";
  Discovery discovery = testing::MakeDiscovery();
  discovery.effects[1].labels = {hostile};
  discovery.effects[0].description = hostile;
  discovery.effects[0].could_also_be = {{hostile, hostile}};
  discovery.steps[0].candidates[0].name = discovery.steps[0].added = hostile;
  discovery.where.poses[0].what = hostile;
  discovery.not_testable[0] = {hostile, hostile};
  discovery.detectable[0].name = hostile;
  discovery.warnings = {hostile};
  for (PoseGap& pose : discovery.poses) pose.label = hostile;
  RunRecord record = Record();
  record.inputs = {hostile};
  record.settings = {{"out", hostile}};
  const std::string dom = Dom(Html(discovery, record));
  EXPECT_THAT(dom,
              AllOf(HasSubstr("<title>Gap discovery: demo</title>"),
                    Not(HasSubstr("<img")),
                    HasSubstr("&lt;img")));
  EXPECT_EQ(Count(dom, "class=\"plot js-plotly-plot\""), FlatCharts().empty() ? 0 : 23);
}

TEST_F(InBrowser, PicturesInSpaceAndFlatOnesStandOnOnePage) {
  if (SpaceCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  HtmlPage page("test", "t", "s");
  Chart chart;
  chart.data = nlohmann::ordered_json::array({{{"x", {1, 2}}, {"y", {2, 1}}}});
  page.Figure(chart);
  chart.data[0]["z"] = {1, 2};
  chart.data[0]["type"] = "scatter3d";
  chart.is_in_space = true;
  page.Figure(chart);
  const std::string dom = browser.Dom(page.Html());
  const std::string before_scripts = dom.substr(0, dom.find("plotly.js (cartesian"));
  EXPECT_EQ(Count(before_scripts, "class=\"plot js-plotly-plot\""), 2);
  EXPECT_THAT(before_scripts, AllOf(HasSubstr("<canvas"), Not(HasSubstr("no-webgl"))));
  ExpectQuiet(browser.Console());
}

// The title has the unit already: no mark "100µ" of mm, flat or beside a scale of colours.
TEST_F(InBrowser, MarksOfSmallNumbersArePowersOfTen) {
  if (FlatCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  HtmlPage page("test", "t", "s");
  Chart chart;
  chart.data = nlohmann::ordered_json::array(
      {{{"x", {1, 2}},
        {"y", {1e-4, 3e-4}},
        {"mode", "markers"},
        {"marker", {{"color", {-2e-4, 2e-4}}, {"coloraxis", "coloraxis"}}}}});
  chart.layout = {{"yaxis", Axis("mm", false)}, {"coloraxis", DivergingColours(2e-4, "mm")}};
  page.Figure(chart);
  const std::string dom = Dom(page.Html());
  EXPECT_EQ(Count(dom, "µ<") + Count(dom, "μ<"), 0);
  for (const char* group : {"class=\"ytick\"", "class=\"cbaxis"})
    EXPECT_THAT(dom.substr(dom.find(group)).substr(0, 4000), HasSubstr("×10")) << group;
}

// Two or more pictures on a page of pictures.
TEST_F(InBrowser, AReportPrints) {
  const std::string html = Html(testing::MakeDiscovery());
  const std::string pdf = browser.Pdf(html);
  EXPECT_THAT(pdf.substr(0, 8), StartsWith("%PDF"));
  const int pages = Count(pdf, "/Type /Page\n"), pictures = Count(html, "class=\"plot\"");
  EXPECT_GE(pages, 4);
  EXPECT_LE(pages, FlatCharts().empty() ? 40 : pictures / 2 + 2);
  EXPECT_GT(pdf.size(), 20000u);
  ExpectQuiet(browser.Console());
}

}  // namespace
}  // namespace hexcal
