// SPDX-License-Identifier: BSD-3-Clause
// docs/paper.md puts each equation beside the function that computes it: are they all there?
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace hexcal {
namespace {

constexpr int kEquations = 45;

std::string Read(const std::string& name) {
  std::ostringstream content;
  content << std::ifstream(HEXCAL_SOURCE "/" + name, std::ios::binary).rdbuf();
  return content.str();
}

TEST(PaperDoc, EveryEquationHasAFunctionThatStandsInItsFile) {
  const std::regex row(R"(\| \((\d+)\) \| [^\n]* \| `(\w+)` \| `([\w./]+)` \|)");
  const std::string text = Read("docs/paper.md");
  std::set<int> equations;
  for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at) {
    const std::string function = (*at)[2], file = (*at)[3];
    EXPECT_TRUE(equations.insert(std::stoi((*at)[1])).second) << (*at)[1] << " stands twice";
    EXPECT_TRUE(std::regex_search(Read(file), std::regex("\\b" + function + "\\(")))
        << "no " << function << " in " << file;
  }
  EXPECT_EQ(equations.size(), static_cast<std::size_t>(kEquations));
  EXPECT_EQ(*equations.begin(), 1);
  EXPECT_EQ(*equations.rbegin(), kEquations);
}

}  // namespace
}  // namespace hexcal
