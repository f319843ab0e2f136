// SPDX-License-Identifier: BSD-3-Clause
#include "config/number.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "testing/decimal_comma.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::DecimalComma;

TEST(Number, ReadsEveryUsualForm) {
  EXPECT_EQ(ParseDouble("0"), 0.0);
  EXPECT_EQ(ParseDouble("12"), 12.0);
  EXPECT_EQ(ParseDouble("-1.5"), -1.5);
  EXPECT_EQ(ParseDouble("+1.5"), 1.5);
  EXPECT_EQ(ParseDouble(".5"), 0.5);
  EXPECT_EQ(ParseDouble("1."), 1.0);
  EXPECT_EQ(ParseDouble("1e-3"), 1e-3);
  EXPECT_EQ(ParseDouble("+2.5E+2"), 250.0);
  EXPECT_TRUE(std::signbit(*ParseDouble("-0")));
}

TEST(Number, RefusesWhatIsNotWhollyANumber) {
  for (const char* text :
       {"",    " ",   " 1", "1 ", "1,5", "1_000", "0x10", "abc",  "1a",   "+",    "-",    "+-1",
        "++1", "--1", "1e", "e5", ".",   "1.2.3", "1;2",  "1 mm", ".nan", ".inf", "1e+-3"})
    EXPECT_EQ(ParseDouble(text), std::nullopt) << text;
}

TEST(Number, ReadsWhatIsNotFiniteForTheCallerToRefuse) {
  EXPECT_TRUE(std::isnan(ParseDouble("nan").value()));
  EXPECT_EQ(ParseDouble("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(ParseDouble("Infinity"), std::numeric_limits<double>::infinity());
}

TEST(Number, TellsTooLargeFromTooSmall) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ParseDouble("1e999"), inf);
  EXPECT_EQ(ParseDouble("-1e999"), -inf);
  EXPECT_EQ(ParseDouble("+1e+999"), inf);
  EXPECT_EQ(ParseDouble("1e99999999999999999999999"), inf);
  EXPECT_EQ(ParseDouble("1e-999"), 0.0);
  EXPECT_EQ(ParseDouble("-1e-999"), 0.0);
  EXPECT_EQ(ParseDouble("1e-99999999999999999999999"), 0.0);
  EXPECT_EQ(ParseDouble(std::string(400, '9')), inf);
  EXPECT_EQ(ParseDouble("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(ParseDouble("0." + std::string(400, '0') + "1e800"), inf);
  EXPECT_EQ(ParseDouble("1" + std::string(400, '0') + "e-800"), 0.0);
  EXPECT_EQ(ParseDouble("0e999999"), 0.0);
}

TEST(Number, EveryDoubleComesBackToTheLastBit) {
  std::mt19937_64 rng = testing::SeededByTest();
  int tried = 0;
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t bits = rng();
    double value = 0;
    static_assert(sizeof value == sizeof bits);
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    ++tried;
    ASSERT_EQ(ParseDouble(fmt::format("{}", value)), value);
  }
  EXPECT_GT(tried, 190000);
  const auto limits = {std::numeric_limits<double>::denorm_min(),
                       std::numeric_limits<double>::min(),
                       std::numeric_limits<double>::max(),
                       std::numeric_limits<double>::lowest()};
  for (const double value : limits) EXPECT_EQ(ParseDouble(fmt::format("{}", value)), value);
}

TEST(Number, ReadsWholeNumbers) {
  EXPECT_EQ(ParseInteger("42"), 42);
  EXPECT_EQ(ParseInteger("-7"), -7);
  EXPECT_EQ(ParseInteger("+7"), 7);
  EXPECT_EQ(ParseInteger("9223372036854775807"), std::numeric_limits<long>::max());
  for (const char* text : {"", "1.0", "1e3", "9223372036854775808", "0x10", " 1", "1_000", "+-1"})
    EXPECT_EQ(ParseInteger(text), std::nullopt) << text;
}

TEST(Number, DoesNotCareForTheLocale) {
  const DecimalComma locale;
  ASSERT_EQ(DecimalComma::Print(1234.5), "1.234,5");  // the locale is in force
  EXPECT_EQ(ParseDouble("1234.5"), 1234.5);
  EXPECT_EQ(ParseDouble("1234,5"), std::nullopt);
  EXPECT_EQ(ParseInteger("1.234"), std::nullopt);
  EXPECT_EQ(fmt::format("{}", 1234.5), "1234.5");
}

TEST(Number, HintsAtTheUsualMistakes) {
  EXPECT_EQ(NumberHint("1,5"), " (the decimal point is '.', not ',')");
  EXPECT_EQ(NumberHint("1_000"), " (without separators between the digits)");
  EXPECT_EQ(NumberHint("1'000"), " (without separators between the digits)");
  EXPECT_EQ(NumberHint("0x10"), " (in decimal, not hexadecimal)");
  EXPECT_EQ(NumberHint("\xE2\x88\x92"
                       "5"),
            " (the minus sign is a plain '-')");
  EXPECT_EQ(NumberHint("1 mm"), " (one number, without a unit or a second number behind it)");
  EXPECT_EQ(NumberHint(".nan"), " (finite: nan and inf cannot be used)");
  EXPECT_EQ(NumberHint("-.inf"), " (finite: nan and inf cannot be used)");
  EXPECT_EQ(NumberHint("nan"), " (finite: nan, inf and too large numbers cannot be used)");
  EXPECT_EQ(NumberHint("1e999"), " (finite: nan, inf and too large numbers cannot be used)");
  EXPECT_EQ(NumberHint("1.5"), "");
  EXPECT_EQ(NumberHint("abc"), "");
  EXPECT_EQ(NumberHint(""), "");
}

}  // namespace
}  // namespace hexcal
