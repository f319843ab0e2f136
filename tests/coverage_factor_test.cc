// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "estimator/intervals.h"
#include "report/estimate_sections.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;

// Base and tool whose numbers all have a standard uncertainty of 0.02 mm and mrad.
Estimate Known() {
  Estimate estimate;
  estimate.converged = true;
  estimate.covariance = Matrix12d::Identity() * 4e-10;
  estimate.observability.determined.fill(true);
  estimate.intervals = IntervalsOfKnownNoise(estimate.covariance);
  return estimate;
}

std::string PageOf(const Estimate& estimate) {
  HtmlPage page("calibrate", "", "");
  AddMounts(estimate, &page);
  return page.Html();
}

std::string Cell(const char* text) { return std::string("<td class=\"number\">") + text + "</td>"; }

// Tables of the normal distribution and of Student's t: 1.960 and, of five degrees of freedom,
// 2.571; 0.02 mm times that.
TEST(CoverageFactor, StandsBesideTheExpandedUncertaintyInBothMounts) {
  Estimate estimate = Known();
  EXPECT_THAT(PageOf(estimate),
              HasSubstr(Cell("0.0200") + Cell("0.0392") + Cell("1.960") + Cell("∞")));
  estimate.intervals = IntervalsOfScaledNoise(estimate.covariance, 5.0);
  const std::string page = PageOf(estimate);
  EXPECT_THAT(page, HasSubstr(Cell("0.0200") + Cell("0.0514") + Cell("2.571") + Cell("5")));
  EXPECT_THAT(page.substr(page.find("Tool on platform")),
              HasSubstr(Cell("0.0200") + Cell("0.0514") + Cell("2.571") + Cell("5")));
}

TEST(CoverageFactor, IsADashWhereNothingIsKnown) {
  EXPECT_EQ(CoverageFactorText(1.0, 0.0), "–");
  EXPECT_EQ(CoverageFactorText(std::numeric_limits<double>::quiet_NaN(), 1.0), "–");
  EXPECT_EQ(CoverageFactorText(0.02, 0.01), "2.000");
}

}  // namespace
}  // namespace hexcal
