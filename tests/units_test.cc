// SPDX-License-Identifier: BSD-3-Clause
#include "config/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace hexcal {
namespace {

TEST(Units, LengthsAndAngles) {
  EXPECT_EQ(FindLengthUnit("m").value().factor, 1.0);
  EXPECT_EQ(FindLengthUnit("mm").value().factor, 1e-3);
  EXPECT_EQ(FindLengthUnit("mm").value().si_symbol, "m");
  EXPECT_EQ(FindAngleUnit("rad").value().factor, 1.0);
  EXPECT_DOUBLE_EQ(180 * FindAngleUnit("deg").value().factor, std::acos(-1.0));
  for (const char* symbol : {"", "cm", "M", "deg", "mm ", "inch"})
    EXPECT_FALSE(FindLengthUnit(symbol)) << symbol;
  for (const char* symbol : {"", "degree", "Rad", "mrad", "mm"})
    EXPECT_FALSE(FindAngleUnit(symbol)) << symbol;
}

TEST(Units, EveryCovariateUnitOfTheFormat) {
  const struct {
    const char* symbol;
    const char* si_symbol;
    double factor;
  } expected[] = {{"s", "s", 1},
                  {"min", "s", 60},
                  {"h", "s", 3600},
                  {"degC", "degC", 1},
                  {"K", "K", 1},
                  {"kg", "kg", 1},
                  {"N", "N", 1},
                  {"m", "m", 1},
                  {"mm", "m", 0.001},
                  {"m/s", "m/s", 1},
                  {"mm/s", "m/s", 0.001},
                  {"rad", "rad", 1},
                  {"rad/s", "rad/s", 1},
                  {"deg", "rad", kPi / 180},
                  {"deg/s", "rad/s", kPi / 180},
                  {"1", "1", 1}};
  for (const auto& unit : expected) {
    const auto found = FindCovariateUnit(unit.symbol);
    ASSERT_TRUE(found) << unit.symbol;
    EXPECT_EQ(found->symbol, unit.symbol);
    EXPECT_EQ(found->si_symbol, unit.si_symbol) << unit.symbol;
    EXPECT_EQ(found->factor, unit.factor) << unit.symbol;
  }
  for (const char* symbol : {"", "C", "g", "ms", "sec", "km/h", "S", "kelvin"})
    EXPECT_FALSE(FindCovariateUnit(symbol)) << symbol;
}

TEST(Units, SiUnitsConvertToThemselves) {
  for (const char* symbol : {"s", "min", "mm/s", "deg/s", "degC", "1"}) {
    const Unit unit = FindCovariateUnit(symbol).value();
    const Unit si = FindCovariateUnit(unit.si_symbol).value();
    EXPECT_EQ(si.si_symbol, si.symbol);
    EXPECT_EQ(si.factor, 1.0);
  }
}

}  // namespace
}  // namespace hexcal
