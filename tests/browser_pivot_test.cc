// SPDX-License-Identifier: BSD-3-Clause
// The report of a pivoting in a real browser, offline.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/html/assets.h"
#include "report/pivot_html.h"
#include "testing/browser.h"
#include "testing/pivot_scene.h"

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

// Drawing in software is slow, and said to be; nothing else is said.
void ExpectQuiet(const std::vector<std::string>& console) {
  for (const std::string& line : console)
    EXPECT_THAT(line, AnyOf(HasSubstr("Performance"), HasSubstr("willReadFrequently")));
}

// With names that would do harm.
TEST(PivotingInBrowser, IsDrawnAndPrintsAndItsNamesAreOnlyNames) {
  testing::Browser browser;
  if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
  const std::string hostile = "</script><img src=x onerror=\"document.title='no'\">";
  auto rng = testing::SeededByTest();
  PivotPoses poses = testing::WithNoise(
      testing::DrawPivotPoses({}, testing::IsotropicNoise(1e-4, 1e-3), rng), rng);
  for (PivotPose& pose : poses.items) pose.label = hostile;
  poses.items[3].world_from_tool.translation.x() += 5e-3;
  PivotOptions options;
  options.reject_outliers = true;
  PivotResult result = CalibratePivot(poses, options);
  result.warnings = {hostile};
  RunRecord record;
  record.inputs = {hostile};
  const std::string html = PivotHtml("demo", record, poses, options, result);
  // The libraries stand behind the page and have tags in their texts.
  const std::string whole = browser.Dom(html);
  const std::string dom = whole.substr(0, whole.find("plotly.js (cartesian"));
  ExpectQuiet(browser.Console());
  const int pictures = FlatCharts().empty() ? 0 : 4;
  EXPECT_EQ(Count(html, "class=\"plot\""), pictures);
  EXPECT_EQ(Count(dom, "class=\"plot js-plotly-plot\""), pictures);
  EXPECT_EQ(Count(dom, "data-complete="), pictures > 0 ? 1 : 0);
  EXPECT_THAT(dom,
              AllOf(HasSubstr("<title>Tool tip by pivoting: demo</title>"),
                    HasSubstr("id=\"verdict\"><strong>determined"),
                    Not(HasSubstr("<img")),
                    HasSubstr("&lt;img")));
  EXPECT_LT(html.size(), std::size_t{8} << 20);
  EXPECT_THAT(browser.Pdf(html).substr(0, 8), StartsWith("%PDF"));
  ExpectQuiet(browser.Console());
}

}  // namespace
}  // namespace hexcal
