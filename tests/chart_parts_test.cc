// SPDX-License-Identifier: BSD-3-Clause
#include "report/chart_parts.h"

#include <gtest/gtest.h>

#include <charconv>
#include <string>

namespace hexcal {
namespace {

// Each mark says its whole value: one in twos and fives alone would say "2" for 0.2.
TEST(LogAxis, MarksOfLessThanTwoDecadesSayTheirValue) {
  const auto axis = LogAxis("RMS", {0.18, 0.6});
  ASSERT_EQ(axis["tickvals"].size(), axis["ticktext"].size());
  bool has_fifth = false, has_half = false;
  for (std::size_t i = 0; i < axis["tickvals"].size(); ++i) {
    const std::string text = axis["ticktext"][i];
    double said = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), said);
    EXPECT_NEAR(said / axis["tickvals"][i].get<double>(), 1.0, 1e-12) << text;
    has_fifth |= text == "0.2";
    has_half |= text == "0.5";
  }
  EXPECT_TRUE(has_fifth && has_half);
  EXPECT_LT(axis["tickvals"].front(), 0.18);
  EXPECT_GT(axis["tickvals"].back(), 0.6);
}

TEST(LogAxis, OfManyDecadesHasPowersOfTen) {
  const auto axis = LogAxis("RMS", {1e-4, 1.0});
  EXPECT_EQ(axis["dtick"], 1);
  EXPECT_FALSE(axis.contains("tickvals"));
  EXPECT_EQ(LogAxis("RMS", {})["type"], "log");
}

}  // namespace
}  // namespace hexcal
