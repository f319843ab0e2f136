// SPDX-License-Identifier: BSD-3-Clause
// What the program draws in a report is what it has computed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/html/assets.h"
#include "testing/run_program.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using Json = nlohmann::json;

const std::string kExample = std::string(HEXCAL_EXAMPLES) + "/neurobot/";

std::string TextOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

// What is drawn under a title; of a page of a build with its chart library.
Json Drawn(const std::string& html, const std::string& title) {
  const std::string before = "aria-label=\"" + title + "\" data-spec=\"";
  const std::size_t at = html.find(before);
  if (at == std::string::npos) return Json();
  const std::size_t name = at + before.size();
  const std::string id = html.substr(name, html.find('"', name) - name);
  const std::string tag = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = html.find(tag) + tag.size();
  return Json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

// Positions in mm that are called m: legs as long as the machine's are only with that mended.
TEST(ReportOfAModel, IsOfThePosesThatItsFaultsWereMendedIn) {
  if (FlatCharts().empty()) GTEST_SKIP() << "built without plotly.js";
  const TemporaryFolder folder;
  folder.Write("dataset.yaml", TextOf(kExample + "dataset.yaml"));
  folder.Write("markers.csv", TextOf(kExample + "markers.csv"));
  std::istringstream lines(TextOf(kExample + "poses.csv"));
  std::string poses, line;
  std::getline(lines, line);
  poses = line + "\n";
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int k = 0; std::getline(cells, cell, ','); ++k)
      poses += (k > 0 ? "," : "") + cell + (k >= 1 && k <= 3 ? "e3" : "");
    poses += "\n";
  }
  folder.Write("poses.csv", poses);
  folder.Write(
      "model.yaml",
      TextOf(kExample + "truth.yaml") +
          "effects:\n  - {name: wrong_unit, index: [], parameters: {}, found: {of: lengths}, "
          "reference: {factor: 0.001}}\n");
  const ProgramResult run = RunHexcal(
      {{"calibrate", "dataset.yaml", "--model=model.yaml", "--out=out", "--report", "--quiet"},
       folder.Path("")});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string html = folder.Read("out/neurobot/report.html");
  const Json legs = Drawn(html, "Leg residuals against leg length");
  ASSERT_EQ(legs["data"].size(), 6u);
  for (const Json& leg : legs["data"]) {
    ASSERT_EQ(leg["x"].size(), 60u);
    for (const Json& length : leg["x"]) {
      EXPECT_GT(length.get<double>(), 205.0);  // mm, the limits of the example's legs
      EXPECT_LT(length.get<double>(), 295.0);
    }
    for (const Json& missing : leg["y"]) EXPECT_LT(std::abs(missing.get<double>()), 0.5);
  }
}

}  // namespace
}  // namespace hexcal
