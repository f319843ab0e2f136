// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "report/html/assets.h"
#include "report/html/escape.h"
#include "testing/audits.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class AuditHtmlTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    audit = new Audit(MakeAudit(testing::AuditExample().Input(testing::ExampleRequirements())));
  }
  static void TearDownTestSuite() { delete audit; }

  static std::string Page(const std::string& result) {
    return AuditHtml({{{"d.yaml", "00"}}, "0123456789abcdef"}, {}, *audit, result);
  }

  static Audit* audit;
};
Audit* AuditHtmlTest::audit = nullptr;

// What would not open well is left beside the page, and the page says so.
TEST_F(AuditHtmlTest, EmbedsItsJsonUnlessThatIsTooLarge) {
  const std::string small = Page("{\"a\": 1}");
  EXPECT_THAT(small, HasSubstr("id=\"audit\">"));
  EXPECT_THAT(small, HasSubstr("id=\"result\">{\"a\": 1}"));
  EXPECT_THAT(small, Not(HasSubstr("too large to be in it")));
  const std::string large = Page("{\"a\": \"" + std::string(8 << 20, 'x') + "\"}");
  EXPECT_THAT(large, HasSubstr("too large to be in it"));
  EXPECT_EQ(large.find("id=\"audit\">"), std::string::npos);
  EXPECT_EQ(large.find("id=\"result\">"), std::string::npos);
  EXPECT_LT(large.size(), small.size() + 1000);
}

// The short number, allowed by the page's own policy.
TEST_F(AuditHtmlTest, HasItsNumberAtTheFootOfPrintedPages) {
  const std::string page = Page("{}");
  const std::size_t at = page.find("@page { @bottom-left");
  ASSERT_NE(at, std::string::npos);
  const std::string style = page.substr(at, page.find("</style>", at) - at);
  EXPECT_THAT(style, HasSubstr("report 0123456789ab\""));
  EXPECT_THAT(page.substr(0, at), HasSubstr(EscapeHtml(PolicyHash(style))));
}

// Of several requirements each is named with its own verdict; one alone needs no name.
TEST_F(AuditHtmlTest, TheVerdictNamesEachOfSeveralRequirements) {
  const auto box = [](const Audit& some) {
    const std::string page = AuditHtml({}, {}, some, "{}");
    const std::size_t at = page.find("id=\"verdict\"");
    return page.substr(at, page.find("</p>", at) - at);
  };
  EXPECT_THAT(box(*audit), Not(HasSubstr("drilling")));
  Audit two = *audit;
  two.decisions.push_back(two.decisions[0]);
  two.decisions[1].requirement.name = "milling";
  two.decisions[1].compliance = Compliance::kFail;
  EXPECT_THAT(box(two), AllOf(HasSubstr("drilling (PASS): "), HasSubstr("milling (FAIL): ")));
}

// Of a pose that was left out, in the pictures of held-out and of smallest errors: a cross, and
// one.
TEST_F(AuditHtmlTest, PicturesOfPosesHaveACrossForEachThatWasLeftOut) {
  Audit some = *audit;
  some.left_over.poses.used[3] = false;
  const std::string page = AuditHtml({}, {}, some, "{}");
  for (const char* title : {"<h3>Each pose as the others predict it</h3>",
                            "<h3>The smallest error of a pose that would be found</h3>"}) {
    const std::size_t begin = page.find(title);
    ASSERT_NE(begin, std::string::npos) << title;
    const std::string figure = page.substr(begin, page.find("</figure>", begin) - begin);
    EXPECT_THAT(figure, HasSubstr("A cross is of a pose that was left out"));
    if (FlatCharts().empty()) continue;
    const std::string symbols = "\"symbol\":[";
    const std::size_t at = figure.find(symbols) + symbols.size();
    const std::string drawn = figure.substr(at, figure.find(']', at) - at);
    const std::size_t cross = drawn.find("x-thin-open");
    EXPECT_EQ(std::count(drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(cross), ','),
              3);
    EXPECT_EQ(drawn.find("x-thin-open", cross + 1), std::string::npos);
  }
}

TEST_F(AuditHtmlTest, AnglesOfTheWorkspaceAreInDegreesToo) {
  EXPECT_THAT(Page("{}"), HasSubstr("139.6 (8°)"));  // as examples/neurobot/requirement.yaml asks
}

}  // namespace
}  // namespace hexcal
