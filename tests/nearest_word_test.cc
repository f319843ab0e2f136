// SPDX-License-Identifier: BSD-3-Clause
#include "config/nearest_word.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "testing/random.h"

namespace hexcal {
namespace {

std::string RandomWord(std::mt19937_64& random) {
  std::string word(std::uniform_int_distribution<std::size_t>(0, 7)(random), 'a');
  for (char& c : word) c = static_cast<char>('a' + std::uniform_int_distribution<>(0, 2)(random));
  return word;
}

TEST(EditDistance, CountsEachKindOfMistakeOnce) {
  EXPECT_EQ(EditDistance("solver", "solver"), 0u);
  EXPECT_EQ(EditDistance("solver", "SOLVER"), 0u);
  EXPECT_EQ(EditDistance("solver", "slver"), 1u);
  EXPECT_EQ(EditDistance("solver", "sollver"), 1u);
  EXPECT_EQ(EditDistance("solver", "solvar"), 1u);
  EXPECT_EQ(EditDistance("solver", "sovler"), 1u);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(EditDistance("ca", "abc"), 3u);  // no letter is changed twice
  EXPECT_EQ(EditDistance("", "abc"), 3u);
}

TEST(NearestWord, FindsTheLetterInTheMiddleOfAShortWord) {
  EXPECT_EQ(NearestWord("ot", {"out", "solver", "seed"}), "out");
  EXPECT_EQ(NearestWord("ot", {"out", "opt"}), "");  // which?
  EXPECT_EQ(NearestWord("xt", {"out"}), "");
}

TEST(EditDistance, IsSymmetricAndBoundedByLengths) {
  std::mt19937_64 random = testing::SeededByTest();
  for (int i = 0; i < 500; ++i) {
    const std::string a = RandomWord(random), b = RandomWord(random);
    const std::size_t distance = EditDistance(a, b);
    EXPECT_EQ(distance, EditDistance(b, a)) << a << " " << b;
    EXPECT_EQ(distance == 0, a == b) << a << " " << b;
    EXPECT_LE(distance, std::max(a.size(), b.size()));
    EXPECT_GE(distance, std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
  }
}

TEST(NearestWord, IsNearOnly) {
  const std::vector<std::string_view> known = {"name", "file", "measurement", "units"};
  EXPECT_EQ(NearestWord("nmae", known), "name");
  EXPECT_EQ(NearestWord("Name", known), "name");
  EXPECT_EQ(NearestWord("unit", known), "units");
  EXPECT_EQ(NearestWord("measurements", known), "measurement");
  EXPECT_EQ(NearestWord("fil", known), "file");
  EXPECT_EQ(NearestWord("xy", known), "");
  EXPECT_EQ(NearestWord("payload", known), "");
  EXPECT_EQ(NearestWord("", known), "");
  EXPECT_EQ(NearestWord(std::string(100000, 'x'), known), "");
}

TEST(NearestWord, IsStricterWithShortWords) {
  const std::vector<std::string_view> known = {"x", "rx", "rows", "poses"};
  EXPECT_EQ(NearestWord("X", known), "x");
  EXPECT_EQ(NearestWord("y", known), "");
  EXPECT_EQ(NearestWord("ry", known), "");
  EXPECT_EQ(NearestWord("rwos", known), "rows");
  EXPECT_EQ(NearestWord("rawz", known), "");
}

TEST(NearestWord, TakesABeginningThatOnlyOneHas) {
  const std::vector<std::string_view> known = {"calibrate", "compare", "completion"};
  EXPECT_EQ(NearestWord("cal", known), "calibrate");
  EXPECT_EQ(NearestWord("ca", known), "");
  EXPECT_EQ(NearestWord("comp", known), "");
  EXPECT_EQ(NearestWord("ou", {"out", "outliers"}), "out");
  EXPECT_EQ(NearestWord("ou", {"out", "our"}), "");
}

TEST(NearestWord, IsAskedForInOneForm) {
  EXPECT_EQ(DidYouMean("nmae", {"name"}), " (did you mean 'name'?)");
  EXPECT_EQ(DidYouMean("zzz", {"name"}), "");
}

}  // namespace
}  // namespace hexcal
