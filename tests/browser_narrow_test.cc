// SPDX-License-Identifier: BSD-3-Clause
// Reports on a screen 400 px wide: nothing is cut off, no text of a picture lies on another.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "report/audit_html.h"
#include "report/calibrate_html.h"
#include "report/compare_html.h"
#include "report/discovery_html.h"
#include "report/html/assets.h"
#include "report/pivot_html.h"
#include "report/space_parts.h"
#include "testing/audits.h"
#include "testing/browser.h"
#include "testing/discoveries.h"
#include "testing/pivot_scene.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;

// Writes what is wrong into a paragraph once all pictures are drawn. What scrolls may be wider.
// Slanted labels may overlap by their boxes, not by their letters: they are not compared.
constexpr char kLook[] = R"(
// What is drawn in space has no boxes: at the edges of its canvas there is nothing, else it is cut
// off there; no axis has more words than there is room for.
function edges(plot, found) {
  const inside = plot._fullLayout && plot._fullLayout.scene && plot._fullLayout.scene._scene;
  if (!inside) return;
  const gl = inside.glplot.gl, name = plot.getAttribute("aria-label");
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight;
  inside.glplot.redraw();
  const read = function (x, y, w, h) {
    const pixels = new Uint8Array(4 * w * h);
    gl.readPixels(x, y, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return pixels.filter((value, i) => i % 4 === 3 && value > 0).length;
  };
  if (read(0, 0, width, height) < 100) found.push("nothing is drawn: " + name);
  if (read(0, 0, 2, height) + read(width - 2, 0, 2, height) + read(0, 0, width, 2) + read(0, height - 2, width, 2))
    found.push("cut off in space: " + name);
  for (const k of [0, 1, 2])
    if (inside.glplot.axes.ticks[k].length > 6) found.push("crowded in space: " + name);
}
function lines(page) {
  const found = [];
  for (const plot of page.querySelectorAll(".plot")) edges(plot, found);
  if (page.documentElement.scrollWidth > 400) found.push("the page is too wide");
  for (const e of page.querySelectorAll("body *"))
    if (!e.closest(".scroll") && !e.closest(".plot") && e.getBoundingClientRect().right > 401)
      found.push("too wide: " + e.tagName);
  for (const plot of page.querySelectorAll(".plot")) {
    const whole = plot.getBoundingClientRect(), name = plot.getAttribute("aria-label");
    const texts = Array.from(plot.querySelectorAll("svg text"))
      .filter(e => e.textContent.trim() && e.getBoundingClientRect().width > 0)
      .map(e => ({ text: e.textContent, box: e.getBoundingClientRect(),
                   slant: Number((/rotate\((-?[0-9.]+)/.exec(e.getAttribute("transform")) || [0, 0])[1]) }));
    texts.forEach((a, i) => {
      if (a.box.left < whole.left - 1 || a.box.right > whole.right + 1 || a.box.bottom > whole.bottom + 1)
        found.push("cut off: " + a.text + ", " + name);
      if (a.slant % 90 !== 0) return;
      for (const b of texts.slice(0, i))
        if (b.slant % 90 === 0 &&
            Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left) > 2 &&
            Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top) > 3)
          found.push("on each other: " + b.text + " and " + a.text + ", " + name);
    });
  }
  return found;
}
function look() {
  const page = document.getElementById("framed").contentDocument;
  if (!page || !page.documentElement.dataset.complete) return window.setTimeout(look, 100);
  const found = document.createElement("p");
  const all = lines(page);
  found.textContent = "found " + all.length + ": " + all.join("; ");
  document.body.appendChild(found);
}
look();
)";

class OnANarrowScreen : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!browser.IsThere()) FAIL() << "no Chromium: scripts/install_dependencies test";
    if (FlatCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  }
  void ExpectNothingWrong(const std::string& html) {
    const std::string dom = browser.FramedDom(html, 400, kLook);
    EXPECT_THAT(dom.substr(std::min(dom.size(), dom.rfind("<p>"))), HasSubstr("<p>found 0: </p>"));
  }
  testing::Browser browser;
};

TEST_F(OnANarrowScreen, WhatIsWrongIsFound) {
  HtmlPage page("test", "t", "s");
  Chart chart;
  chart.data = nlohmann::ordered_json::array({{{"x", {1, 2}}, {"y", {2, 1}}}});
  chart.layout["xaxis"]["title"]["text"] = std::string(99, 'x');
  page.Figure(chart);
  EXPECT_THAT(browser.FramedDom(page.Html(), 400, kLook), HasSubstr("cut off: xxx"));
}

// Too near to be seen whole.
TEST_F(OnANarrowScreen, WhatIsCutOffInSpaceIsFound) {
  HtmlPage page("test", "t", "s");
  Chart chart;
  chart.is_in_space = true;
  chart.data.push_back(SpaceTrace(
      "a", "lines", {Eigen::Vector3d::Zero(), Eigen::Vector3d(0.3, 0.2, 0.1)}, 0, "@ink"));
  chart.layout = SpaceLayout(chart.data);
  page.Figure(chart);
  ExpectNothingWrong(page.Html());
  for (const char* axis : {"x", "y", "z"})
    for (auto& end : chart.layout["scene"][std::string(axis) + "axis"]["range"])
      end = 0.4 * end.get<double>();
  HtmlPage near("test", "t", "s");
  near.Figure(chart);
  EXPECT_THAT(browser.FramedDom(near.Html(), 400, kLook), HasSubstr("cut off in space: "));
}

TEST_F(OnANarrowScreen, ADiscoveryIsWhole) {
  const Discovery discovery = testing::MakeDiscovery();
  const Dataset dataset = testing::DatasetOf(discovery);
  ExpectNothingWrong(DiscoveryHtml(
      "demo", {}, discovery, MakeScene(dataset, discovery), ResidualsOf(dataset, discovery)));
}

TEST_F(OnANarrowScreen, APivotingIsWhole) {
  auto rng = testing::SeededByTest();
  const PivotPoses poses = testing::WithNoise(
      testing::DrawPivotPoses({}, testing::IsotropicNoise(1e-4, 1e-3), rng), rng);
  ExpectNothingWrong(PivotHtml("demo", {}, poses, {}, CalibratePivot(poses, {})));
}

TEST_F(OnANarrowScreen, CalibrationComparisonAndAuditAreWhole) {
  const testing::AuditedExample example = testing::AuditExample();
  const Scene scene = MakeScene(example.dataset, example.observations, example.estimate);
  const LeftOver left = MakeLeftOver(example.dataset, example.observations, example.estimate);
  ExpectNothingWrong(CalibrateHtml({"demo", "nonlinear", "pose", ""},
                                   {},
                                   example.estimate,
                                   FrameGraphOf(example.dataset, {}),
                                   scene,
                                   left));
  ExpectNothingWrong(CompareHtml("demo", {}, example.comparison, scene, left));
  const Requirements requirements = testing::ExampleRequirements();
  AuditInput input = example.Input(requirements);
  DiscoverOptions options;
  options.bootstraps = 99;
  input.missing = Screen(example.dataset, options, {requirements.points[0].p_in_tool});
  const Audit audit = MakeAudit(std::move(input));
  ASSERT_TRUE(audit.missing);  // else its pictures are not looked at
  ASSERT_GT(audit.missing->tested.size(), 12u);
  ExpectNothingWrong(AuditHtml({}, {}, audit, ResultJson(audit.header, audit.estimate)));
}

}  // namespace
}  // namespace hexcal
