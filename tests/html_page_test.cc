// SPDX-License-Identifier: BSD-3-Clause
// Pages as text: what is plain text stays plain text, and the policy allows the page's own scripts
// and style alone. What a browser makes of them: browser_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/html/assets.h"
#include "report/html/escape.h"
#include "report/html/page.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kHostile = "</script><img src=x onerror=\"document.title='no'\">&amp;";

TEST(EscapeHtml, LeavesNoMarkup) {
  EXPECT_EQ(EscapeHtml("a < b & \"c\" > 'd'"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(EscapeHtml("µm ± 3 \n\t"), "µm ± 3 \n\t");
  EXPECT_EQ(EscapeHtml(std::string("a\0b\x1b\x7f", 5)), "a\uFFFDb\uFFFD\uFFFD");
  EXPECT_EQ(EscapeHtml("x\xff"), "x\uFFFD");
  EXPECT_EQ(EscapeHtml(""), "");
  EXPECT_THAT(EscapeHtml(kHostile), AllOf(Not(HasSubstr("<")), Not(HasSubstr("\""))));
}

TEST(EscapeLabel, LeavesNoTags) {
  EXPECT_EQ(EscapeLabel("<b>a</b> & 'b'"), "&lt;b&gt;a&lt;/b&gt; &amp; 'b'");
}

TEST(JsonForScript, CannotEndItsScriptAndReadsBack) {
  const nlohmann::ordered_json value = {{"name", kHostile}, {"x", 0.1}};
  const std::string text = JsonForScript(value);
  EXPECT_THAT(text, AllOf(Not(HasSubstr("<")), Not(HasSubstr(">"))));
  EXPECT_EQ(nlohmann::ordered_json::parse(text), value);
}

// A name of a file may be anything, and may not end the script.
TEST(JsonTextForScript, ChangesNothingButWhatCouldEndItsScript) {
  const std::string text = "{\n  \"name\": \"</script><!-- & > \\u003c\"\n}\n";
  const std::string escaped = JsonTextForScript(text);
  EXPECT_THAT(escaped, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::ordered_json::parse(escaped), nlohmann::ordered_json::parse(text));
  EXPECT_EQ(JsonTextForScript("{\"a\": 1}\n"), "{\"a\": 1}\n");
}

TEST(PolicyHash, IsThatOfTheStandardsExample) {
  // FIPS 180: SHA-256 of "abc" and of nothing, in base 64.
  EXPECT_EQ(PolicyHash("abc"), "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='");
  EXPECT_EQ(PolicyHash(""), "'sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU='");
}

Chart SomeChart() {
  Chart chart;
  chart.title = "A picture of " + kHostile;
  chart.shows = "one point.";
  chart.good = "one point.";
  chart.data = nlohmann::ordered_json::array({{{"x", {1}}, {"y", {2}}, {"text", kHostile}}});
  chart.table = {{{"name"}, {"size", true}}, {{kHostile, "0.125 mm"}}};
  return chart;
}

TEST(HtmlPage, StartsWithItsMarkAndHasEveryText) {
  HtmlPage page("test", "A title", "and more");
  page.Section("A section");
  page.Heading("A heading");
  page.Paragraph("A paragraph");
  page.Note("A note");
  page.List({"an item"});
  page.Table({{{"a column"}}, {{"a cell"}}});
  page.Code("some code");
  page.Verdict(Tone::kWarn, "verdict", "a word", "a sentence");
  const std::string html = page.Html();
  EXPECT_THAT(html, StartsWith("<!doctype html>\n" + HtmlPage::Mark("test")));
  for (const char* text : {"<title>A title</title>",
                           "and more",
                           "<h2>A section</h2>",
                           "<h3>A heading</h3>",
                           "<p>A paragraph</p>",
                           "A note",
                           "<li>an item</li>",
                           "<th>a column</th>",
                           "<td>a cell</td>",
                           "<pre>some code</pre>",
                           "<strong>a word</strong>",
                           "a sentence"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_THAT(html, Not(HasSubstr("<script")));  // no picture, no script
  EXPECT_THAT(html, HasSubstr("script-src &#39;none&#39;"));
}

TEST(HtmlPage, NothingHostileBecomesMarkup) {
  HtmlPage page("test", kHostile, kHostile);
  page.Section(kHostile);
  page.Heading(kHostile);
  page.Paragraph(kHostile);
  page.Note(kHostile);
  page.List({kHostile});
  page.Table({{{kHostile}}, {{kHostile}}});
  page.Code(kHostile);
  page.Verdict(Tone::kBad, kHostile, kHostile, kHostile);
  page.Figure(SomeChart());
  EXPECT_THAT(page.Html(), AllOf(Not(HasSubstr("<img")), Not(HasSubstr("onerror=\""))));
}

TEST(HtmlPage, NumbersOfAPictureStandInATableToo) {
  HtmlPage page("test", "t", "s");
  page.Figure(SomeChart());
  const std::string html = page.Html();
  EXPECT_THAT(html, HasSubstr("<td class=\"number\">0.125 mm</td>"));
  EXPECT_THAT(html, HasSubstr("<b>Shows</b> one point. <b>Good looks like</b> one point."));
  if (FlatCharts().empty())
    EXPECT_THAT(html,
                AllOf(HasSubstr("without its chart library"), Not(HasSubstr("class=\"plot"))));
  else
    EXPECT_THAT(html,
                AllOf(HasSubstr("<details>"), HasSubstr(EscapeHtml(PolicyHash(FlatCharts())))));
}

TEST(HtmlPage, HoldsTheLibraryOfItsKindOfPictureOnly) {
  if (FlatCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  HtmlPage page("test", "t", "s");
  page.Figure(SomeChart());
  EXPECT_EQ(page.Html().find(SpaceCharts()), std::string::npos);
  EXPECT_NE(page.Html().find(FlatCharts()), std::string::npos);
}

// On paper nothing can be hovered over, and tables that are folded are not there: it says where.
TEST(HtmlPage, SaysOnPaperWhatHoldsThere) {
  HtmlPage page("test", "t", "s");
  Chart chart;
  chart.shows = "dots (mm), in order (hover for the pose's name). More.";
  chart.data = nlohmann::ordered_json::array({{{"x", {1}}, {"y", {2}}}});
  page.Figure(chart);
  EXPECT_THAT(
      page.Html(),
      HasSubstr("(mm), in order<span class=\"screen\"> (hover for the pose&#39;s name)</span>. "
                "More."));
  EXPECT_THAT(page.Html(), Not(HasSubstr("Printed without")));
  chart.table = {{{"x", true}}, {{"1"}}};
  page.Figure(chart);
  const std::string said = FlatCharts().empty() ? "" : "<p class=\"note paper\">Printed without";
  EXPECT_THAT(page.Html(), HasSubstr(said));
  EXPECT_THAT(std::string(PageCss()), HasSubstr(".modebar, .screen { display: none; }"));
}

}  // namespace
}  // namespace hexcal
