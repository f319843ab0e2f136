// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>

#include "config/number.h"
#include "testing/random.h"

namespace hexcal {
namespace {

// https://yaml.org/type/float.html and int.html, as common readers of YAML 1.1 take them.
bool IsNumberOfYaml11(const std::string& text) {
  static const std::regex number(R"([-+]?(0|[1-9][0-9]*)|[-+]?[0-9]+\.[0-9]*([eE][-+][0-9]+)?)");
  return std::regex_match(text, number);
}

TEST(YamlNumber, IsTheShortestTextWithAPoint) {
  EXPECT_EQ(YamlNumber(3e-5), "3.0e-05");
  EXPECT_EQ(YamlNumber(-3e-5), "-3.0e-05");
  EXPECT_EQ(YamlNumber(1.25e-7), "1.25e-07");
  EXPECT_EQ(YamlNumber(1e300), "1.0e+300");
  EXPECT_EQ(YamlNumber(0.1), "0.1");
  EXPECT_EQ(YamlNumber(-2), "-2");
  const double three[] = {1, 2.5, 3e-5};
  EXPECT_EQ(YamlNumbers(three, 3), "[1, 2.5, 3.0e-05]");
  EXPECT_EQ(YamlNumbers(three, 0), "[]");
}

TEST(YamlNumber, IsANumberToEveryReaderAndComesBackToTheLastBit) {
  std::mt19937_64 rng = testing::SeededByTest();
  int with_exponent = 0;
  for (int i = 0; i < 20000; ++i) {
    // Few digits or all, of every size.
    const double power = std::pow(10.0, std::uniform_int_distribution<int>(-300, 300)(rng));
    const double value = i % 2 == 0 ? std::uniform_int_distribution<int>(-9, 9)(rng) * power
                                    : std::normal_distribution<double>()(rng) * power;
    const std::string text = YamlNumber(value);
    EXPECT_TRUE(IsNumberOfYaml11(text)) << text;
    const double back = ParseDouble(text).value();
    EXPECT_EQ(std::memcmp(&back, &value, sizeof value), 0) << text;
    with_exponent += text.find('e') != std::string::npos;
  }
  EXPECT_GT(with_exponent, 10000);
}

}  // namespace
}  // namespace hexcal
