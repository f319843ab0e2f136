// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit from outside: which fit is reported, tested and repeated, and its bad readings.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testing/cli_audit.h"

namespace hexcal {
namespace {

using ::hexcal::testing::CliAudit;
using ::hexcal::testing::kAudited;
using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

// The solutions side by side are those that calibrate finds alone.
TEST_F(CliAudit, TheReportHasTheEstimatesOfEachSolution) {
  ASSERT_EQ(Audit({}).status, 0);
  std::string row = "<td>base x, mm</td>";
  const std::array<std::vector<std::string>, 3> ways = {{{"--residual=marker"},  // the audit's own
                                                         {"--residual=pose"},
                                                         {"--solver=linearized"}}};
  for (const std::vector<std::string>& way : ways) {
    std::vector<std::string> args = {"calibrate", kAudited + "dataset.yaml", "--out=c"};
    args.insert(args.end(), way.begin(), way.end());
    const ProgramResult found = RunHexcal({args, folder.Path("")});
    ASSERT_EQ(found.status, 0) << found.err;
    const Json result = Json::parse(folder.Read("c/neurobot/result.json"));
    row += fmt::format("<td class=\"number\">{:.4f}</td>",
                       1e3 * result["world_from_base"]["xyz"][0].get<double>());
  }
  EXPECT_THAT(Read("report.html"), HasSubstr(row));
}

// Page, table and audit.json name the fit, what of it is tested and what is repeated.
TEST_F(CliAudit, SaysWhichFitIsTestedAndRepeated) {
  for (const char* way : {"--solver=linearized", "--loss=tukey"}) {
    const ProgramResult found = Audit({way});
    const Json json = Json::parse(Read("audit.json"));
    EXPECT_EQ(json["propagation"]["repeated_is_fit"], true);
    EXPECT_EQ(json["global_test"]["tested"], "least_squares");
    EXPECT_THAT(found.out, HasSubstr("by least squares, none weighted down"));
    EXPECT_THAT(Read("report.html"), HasSubstr("has no chi-square distribution and is not tested"));
    EXPECT_THAT(Read("report.html"),
                HasSubstr("Repeated is the fit of this report: " +
                          json["propagation"]["repeated"].get<std::string>().substr(0, 8)));
  }
  EXPECT_THAT(Read("report.html"), HasSubstr("<li>Loss: Tukey&#39;s"));
  EXPECT_EQ(Json::parse(Read("audit.json"))["fit"]["loss"], "tukey");
  EXPECT_EQ(Json::parse(Read("result.json"))["loss"]["kind"], "tukey");
}

// Simulated data without noise, of which the noise is stated, end in a report that asks for
// nothing.
TEST_F(CliAudit, OfExactDataIsAReport) {
  const std::string truth = "--model=" + kAudited + "truth.yaml";
  ASSERT_EQ(Call({"simulate", kAudited + "plan.yaml", truth, "--noise=0", "--out=s"}).status, 0);
  const ProgramResult found =
      Call({"audit", "s/neurobot/dataset.yaml", "--out=out", "--draws=1000"});
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("smaller than the stated noise"));
  EXPECT_THAT(found.out, Not(HasSubstr("the data ask for")));
}

// The same readings without their noise, 1:1:2 along the tracker's axes: two levels of poses do not
// tell it, and what they state is not enough to pass.
TEST_F(CliAudit, DoubtsANoiseThatWasTakenForAlike) {
  std::string text;
  std::ifstream in(kAudited + "dataset.yaml");
  for (std::string line; std::getline(in, line);)
    if (line.find("noise: {sigma:") == std::string::npos) text += line + "\n";
  folder.Write("dataset.yaml", text);
  for (const char* name : {"markers.csv", "poses.csv"})
    std::filesystem::copy_file(kAudited + name, folder.Path(name));
  const ProgramResult found =
      Call({"audit", "dataset.yaml", bundled, "--residual=pose", "--draws=1000", "--out=out"});
  EXPECT_EQ(Json::parse(folder.Read("out/neurobot/audit.json"))["verdict"], "INCONCLUSIVE");
  EXPECT_THAT(found.out, HasSubstr("the markers' noise is not alike along the tracker's axes"));
  EXPECT_THAT(found.out, HasSubstr("(measurement: noise: sigma; along the tracker's x, y, z"));
}

// Half a millimetre in one marker of one pose: page, table, audit.json and calibrate name it.
TEST_F(CliAudit, NamesABadReadingOfOneMarker) {
  std::string rows;
  std::ifstream in(kAudited + "markers.csv");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("18,tool,t2,", 0) == 0) {
      const auto comma = line.find(',', 11);
      line = fmt::format(
          "18,tool,t2,{}{}", std::stod(line.substr(11, comma - 11)) + 5e-4, line.substr(comma));
    }
    rows += line + "\n";
  }
  folder.Write("markers.csv", rows);
  for (const char* name : {"dataset.yaml", "poses.csv"})
    std::filesystem::copy_file(kAudited + name, folder.Path(name));
  const ProgramResult found = RunHexcal({{"audit",
                                          "dataset.yaml",
                                          "--requirement=" + kAudited + "requirement.yaml",
                                          "--draws=1000",
                                          "--out=out"},
                                         folder.Path("")});
  EXPECT_THAT(found.out, HasSubstr("tool/t2 in pose 18"));
  EXPECT_THAT(found.out, HasSubstr("in place of that by the readings of all markers"));
  EXPECT_THAT(found.err, HasSubstr("the others contradict tool/t2 in pose 18"));
  const Json json = Json::parse(folder.Read("out/neurobot/audit.json"));
  EXPECT_EQ(json["propagation"]["repeated_is_fit"], false);
  ASSERT_EQ(json["readings"]["contradicting"].size(), 1u);
  const Json bad = json["readings"]["contradicting"][0];
  EXPECT_EQ(bad["pose"], "18");
  EXPECT_EQ(bad["marker"], "tool/t2");
  EXPECT_EQ(bad["used"], true);
  EXPECT_NEAR(bad["held_out"][0].get<double>(), 5e-4, 2e-4);
  EXPECT_EQ(json["readings"]["worst"][0], bad);
  EXPECT_EQ(json["readings"]["all"].size(), 360u);
  EXPECT_EQ(json["verdict"], "INCONCLUSIVE");
  const std::string page = folder.Read("out/neurobot/report.html");
  EXPECT_THAT(page, HasSubstr("<td>18</td><td>tool/t2</td>"));
  EXPECT_THAT(page, HasSubstr("a marker&#39;s reading that the others contradict was used"));
  EXPECT_EQ(json["global_test"]["degrees_of_freedom"], 708);  // all rows are used as before
}

TEST_F(CliAudit, TheReportHasTheCallAsAShellReadsItBack) {
  ASSERT_EQ(Audit({"--operator=second shift", "--history=" + folder.Path("h.sqlite")}).status, 0);
  EXPECT_THAT(Read("report.html"), HasSubstr("dataset.yaml \\\n  --out="));
  EXPECT_THAT(Read("report.html"), HasSubstr("--folds=2"));
  EXPECT_THAT(Read("report.html"), HasSubstr("--operator=&#39;second shift&#39;"));
}

}  // namespace
}  // namespace hexcal
