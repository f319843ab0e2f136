// SPDX-License-Identifier: BSD-3-Clause
// The reports of audit, calibrate and compare in a real browser, offline. Fails where there is
// no Chromium.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/audit_html.h"
#include "report/calibrate_html.h"
#include "report/compare_html.h"
#include "report/html/assets.h"
#include "testing/audits.h"
#include "testing/browser.h"
#include "testing/histories.h"

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

std::string Before(const std::string& text, const char* part) {
  return text.substr(0, text.find(part));
}

// The JSON for programs that stands in the page under this id, as the browser has it.
nlohmann::json DataOf(const std::string& dom, const std::string& id) {
  const std::string tag = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t at = dom.find(tag);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + tag.size();
  return nlohmann::json::parse(dom.substr(begin, dom.find("</script>", begin) - begin));
}

// Drawing in software is slow, and said to be; nothing else is said.
void ExpectQuiet(const std::vector<std::string>& console) {
  for (const std::string& line : console)
    EXPECT_THAT(line, AnyOf(HasSubstr("Performance"), HasSubstr("willReadFrequently")));
}

// With a name that would do harm wherever a file may have one.
TEST(AuditInBrowser, IsDrawnSaysWhatItsJsonSaysAndItsNamesAreOnlyNames) {
  testing::Browser browser;
  if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
  const std::string hostile =
      "</script><script>document.title='no'</script><img src=x onerror=\"document.title='no'\">";
  testing::AuditedExample example = testing::AuditExample();
  for (PoseResult& pose : example.estimate.poses) pose.label = hostile;
  for (Observation& o : example.observations.items) o.label = hostile;
  for (auto& row : example.dataset.robot_poses.rows) row.label = hostile;
  example.estimate.warnings = {hostile};
  example.estimate.outliers.push_back({0, hostile, hostile});
  Requirements requirements = testing::ExampleRequirements();
  requirements.points[0].name = requirements.requirements[0].name = hostile;
  requirements.robot->origin = hostile;
  StatedSource source;
  source.source = {hostile, SourceSite::kWorld, 1e-5, 1e-5};
  source.origin = hostile;
  requirements.sources.push_back(source);
  requirements.identification = {{hostile, hostile}};
  AuditInput input = example.Input(requirements);
  input.earlier = EarlierResult{hostile, hostile, example.estimate.mounts, {}, {}};
  const Audit audit = MakeAudit(input);
  RunRecord record;
  record.version = record.started_utc = hostile;
  record.settings = {{hostile, hostile}};
  AuditIdentity identity = {{{hostile, "00"}}, "11"};
  HistoryRecord kept = testing::AnyRecord(hostile, 1);
  kept.author = {hostile, hostile, hostile};
  kept.version = kept.written = kept.solver = hostile;
  kept.effects = {hostile};
  const testing::TemporaryFolder folder;
  testing::Append(folder.Path("h.sqlite"), kept);
  kept.readings_sha256 = hostile;
  identity.log = MakeChangeLog(hostile, PendingRecord(folder.Path("h.sqlite"), kept));
  record.host = {hostile, 2, hostile};
  const std::string result = ResultJson(audit.header, audit.estimate);
  const std::string html = AuditHtml(identity, record, audit, result);
  // The libraries stand behind the page and have tags in their texts.
  const std::string dom = Before(browser.Dom(html), "plotly.js (cartesian");
  ExpectQuiet(browser.Console());
  const int pictures = Count(html, "class=\"plot\"");
  EXPECT_EQ(pictures, FlatCharts().empty() ? 0 : 20);
  EXPECT_EQ(Count(dom, "class=\"plot js-plotly-plot\""), pictures);
  EXPECT_EQ(Count(dom, "data-complete="), FlatCharts().empty() ? 0 : 1);
  const auto json = nlohmann::json::parse(AuditJson(identity, audit));
  EXPECT_THAT(dom,
              AllOf(HasSubstr(identity.log->mark.head),
                    HasSubstr("id=\"verdict\"><strong>" + json["verdict"].get<std::string>()),
                    HasSubstr("Where the measured poses lie</h3>"),
                    HasSubstr("How the poses are turned</h3>"),
                    HasSubstr("What became of every row</h3>"),
                    HasSubstr("<title>Accuracy audit: neurobot</title>"),
                    Not(HasSubstr("<img")),
                    HasSubstr("&lt;img")));
  EXPECT_EQ(Count(dom, "<svg class=\"drawing\""), 1);
  EXPECT_EQ(DataOf(dom, "audit"), json);
  EXPECT_EQ(DataOf(dom, "result"), nlohmann::json::parse(result));
  EXPECT_LT(html.size(), std::size_t{8} << 20);
  EXPECT_THAT(browser.Pdf(html).substr(0, 8), StartsWith("%PDF"));
  ExpectQuiet(browser.Console());
}

TEST(CalibrationInBrowser, IsDrawnAsItsComparisonIs) {
  testing::Browser browser;
  if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
  testing::AuditedExample example = testing::AuditExample();
  const std::string hostile = "<img src=x onerror=\"document.title='no'\">";
  LeftOver left = MakeLeftOver(example.dataset, example.observations, example.estimate);
  for (std::string& label : left.poses.labels) label = hostile;
  for (PoseResult& pose : example.estimate.poses) pose.label = hostile;
  for (PoseResult& pose : example.comparison.reference.poses) pose.label = hostile;
  for (Observation& o : example.observations.items) o.label = hostile;
  const LeftOver untimed = left;
  left.markers = {{hostile, 2, 1e-4, 2e-4, {{1e-4, 0, 0}, {0, 1e-4, 0}}, {0, 1}, {true, true}},
                  {"tool/t1", 1, 1e-4, 0.0, {{0, 0, 1e-4}}, {1}, {true}}};
  for (std::size_t i = 0; i < example.estimate.poses.size(); ++i)
    left.poses.times.push_back(100.0 * static_cast<double>(i));
  ConvergenceMap& map = example.comparison.paper_map;
  map.rotation_errors = {0.1, 1.0}, map.translation_errors = {0.01}, map.share = {{1.0}, {0.5}};
  RunRecord record;
  record.inputs = {hostile};
  const FrameGraph frames = FrameGraphOf(example.dataset, {hostile});
  const Scene scene = MakeScene(example.dataset, example.observations, example.estimate);
  for (const auto& [html, pictures] :
       {std::pair{
            CalibrateHtml(
                {"demo", "nonlinear", "pose", ""}, record, example.estimate, frames, scene, left),
            17},
        std::pair{CompareHtml("demo", record, example.comparison, scene, untimed), 15}}) {
    const std::string dom = Before(browser.Dom(html), "plotly.js (cartesian");
    ExpectQuiet(browser.Console());
    EXPECT_EQ(Count(html, "class=\"plot\""), FlatCharts().empty() ? 0 : pictures);
    EXPECT_EQ(Count(dom, "class=\"plot js-plotly-plot\""), FlatCharts().empty() ? 0 : pictures);
    EXPECT_THAT(dom, AllOf(HasSubstr(": demo</title>"), Not(HasSubstr("<img"))));
    EXPECT_EQ(Count(dom, "data-complete="), FlatCharts().empty() ? 0 : 1);
    EXPECT_LT(html.size(), std::size_t{8} << 20);
  }
}

}  // namespace
}  // namespace hexcal
