// SPDX-License-Identifier: BSD-3-Clause
#include "report/estimate_sections.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/quantiles.h"
#include "geometry/rotation_angles.h"
#include "report/html/escape.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Both mounts turned by 80 degrees about z, five times as sure along x and about x as elsewhere.
Estimate Turned() {
  Estimate e;
  Vector6d mount;
  mount << 0.03, -0.02, 0.01, 0.0, 0.0, 80.0 * std::acos(-1.0) / 180.0;
  e.mounts.world_from_base = e.mounts.platform_from_tool = PoseFromVector(mount);
  Vector12d sigma = Vector12d::Constant(5e-4);
  for (const int i : {0, 3, 6, 9}) sigma[i] = 1e-4;
  e.covariance = sigma.cwiseAbs2().asDiagonal();
  e.observability.determined.fill(true);
  e.intervals = IntervalsOfScaledNoise(e.covariance, 20.0);
  return e;
}

std::string PageOf(const Estimate& estimate) {
  HtmlPage page("test", "t", "s");
  AddMounts(estimate, &page);
  return page.Html();
}

std::string Row(const std::string& name, const std::vector<std::string>& numbers) {
  std::string row = "<tr><td>" + name + "</td>";
  for (const std::string& number : numbers) row += "<td class=\"number\">" + number + "</td>";
  return row + "</tr>";
}

// Across W's x the base is as unsure as along its own y, nearly: U is of the number in the row.
TEST(EstimateSections, ExpandedUncertaintyIsOfTheNumberBesideIt) {
  const std::string page = PageOf(Turned());
  const double k = StudentTQuantile(0.975, 20.0), c = std::cos(80.0 * std::acos(-1.0) / 180.0);
  const double along_x = 1e-4 * std::sqrt(c * c + 25.0 * (1.0 - c * c));
  const double along_y = 1e-4 * std::sqrt(25.0 * c * c + 1.0 - c * c);
  const auto row = [&](const char* name, double value, double u) {
    return Row(name,
               {MilliText(value), MilliText(u), MilliText(k * u), fmt::format("{:.3f}", k), "20"});
  };
  EXPECT_THAT(page, HasSubstr(row("x,\u00a0mm", 0.03, along_x)));
  EXPECT_THAT(page, HasSubstr(row("y,\u00a0mm", -0.02, along_y)));
  EXPECT_THAT(page, HasSubstr(row("rx,\u00a0mrad", 0.0, along_x)));
}

TEST(EstimateSections, SmallMotionsHaveATableOfTheirOwn) {
  const std::string page = PageOf(Turned());
  const double k = StudentTQuantile(0.975, 20.0);
  const auto row = [&](const char* name, double u) {
    return Row(name, {MilliText(u), MilliText(k * u), fmt::format("{:.3f}", k), "20"});
  };
  EXPECT_THAT(page, HasSubstr(row("base.dx, mm", 1e-4)));
  EXPECT_THAT(page, HasSubstr(row("base.dy, mm", 5e-4)));
  EXPECT_THAT(page, HasSubstr(row("tool.rx, mrad", 1e-4)));
}

// A number of Eq. (2) is a mix of three: lost with any of them.
TEST(EstimateSections, WhatAMixLosesIsNotDetermined) {
  Estimate e = Turned();
  e.observability.determined[1] = false;
  const std::string page = PageOf(e);
  EXPECT_THAT(page,
              HasSubstr("x,\u00a0mm</td><td class=\"number\">30.0000</td>"
                        "<td class=\"number\">not determined</td>"));
  EXPECT_THAT(page, HasSubstr("base.dy, mm</td><td class=\"number\">not determined</td>"));
  EXPECT_THAT(page, Not(HasSubstr("base.dx, mm</td><td class=\"number\">not determined</td>")));
}

TEST(EstimateSections, OfRoundingNoExpandedUncertaintyIsStated) {
  Estimate e = Turned();
  e.covariance *= 1e-26;
  e.intervals = IntervalsOfScaledNoise(e.covariance, 20.0);
  EXPECT_THAT(PageOf(e), HasSubstr(Row("base.dx, mm", {"0", "–", "–", "–"})));
  EXPECT_THAT(PageOf(e), Not(HasSubstr("2.086")));
}

// Flags are on lines of their own but within quotes, where they are none.
TEST(EstimateSections, TheCommandCanBeCopiedFromPaper) {
  RunRecord record;
  record.call = "hexcal audit 'a --b.yaml' --out='it'\\''s --c' --seed=1";
  HtmlPage page("test", "t", "s");
  AddReproduction(record, {}, "", &page);
  EXPECT_THAT(
      page.Html(),
      HasSubstr(EscapeHtml("hexcal audit 'a --b.yaml' \\\n  --out='it'\\''s --c' \\\n  --seed=1")));
}

}  // namespace
}  // namespace hexcal
