// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit from outside: files, exit statuses, refusals. What it decides is tested with the
// report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
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
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Json = nlohmann::json;

TEST_F(CliAudit, LeavesItsFilesAndSaysWhatIsInThem) {
  const ProgramResult result = Audit({bundled, "--gate"});
  EXPECT_EQ(result.status, 0) << result.err;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.Path("out/neurobot")))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(
      names,
      UnorderedElementsAre("audit.json", "result.json", "model.yaml", "run.json", "report.html"));
  const Json audit = Json::parse(Read("audit.json"));
  EXPECT_EQ(audit["verdict"], "PASS");
  EXPECT_EQ(audit["inputs"].size(), 4u);  // dataset, poses, markers, requirement
  EXPECT_EQ(audit["id"].get<std::string>().size(), 64u);
  EXPECT_THAT(result.out, HasSubstr("verdict PASS"));
  EXPECT_THAT(result.out, HasSubstr("written to     out/neurobot"));
  EXPECT_THAT(Read("report.html"), HasSubstr("id=\"verdict\"><strong>PASS</strong>"));
  EXPECT_THAT(Read("report.html"), HasSubstr(audit["id"].get<std::string>()));
  EXPECT_THAT(Read("report.html"),
              HasSubstr("Of report " + audit["id"].get<std::string>() + ".</p>"));  // to be signed
  EXPECT_EQ(Json::parse(Read("result.json"))["residual"], "marker");
  const Json run = Json::parse(Read("run.json"));
  EXPECT_EQ(run["settings"]["folds"], "2");
  EXPECT_EQ(run["versions"][1], "revision " + run["revision"].get<std::string>());
  EXPECT_THAT(Read("report.html"), HasSubstr(", revision " + run["revision"].get<std::string>()));
  std::vector<std::string> timed;
  for (const Json& method : run["methods"]) {
    timed.push_back(method["name"]);
    EXPECT_GT(method["seconds"], 0.0);
    EXPECT_THAT(Read("report.html"), HasSubstr("<td>" + timed.back() + "</td>"));
  }
  EXPECT_THAT(timed, ::testing::IsSupersetOf({"paper", "nonlinear"}));
  EXPECT_GE(run["host"]["processors"].get<int>(), 1);
  EXPECT_THAT(Read("report.html"), HasSubstr(run["host"]["name"].get<std::string>()));
  EXPECT_THAT(Read("report.html"),
              HasSubstr("<td>noise_position</td><td>not set (estimated)</td>"));
  for (const char* name : {"audit.json", "result.json"})  // no times, no host
    EXPECT_FALSE(Json::parse(Read(name)).contains("host")) << name;
  EXPECT_EQ(Json::parse(Read("run.json"))["settings"]["tolerance"], "1e-12");
}

TEST_F(CliAudit, GateTurnsAFailIntoItsStatusAndNothingElseDoes) {
  const std::string limit = "--requirement=" + WithLimit("0.01");
  EXPECT_EQ(Audit({limit, "--quiet"}).status, 0);
  const ProgramResult gated = Audit({limit, "--gate"});
  EXPECT_EQ(gated.status, 7);
  EXPECT_THAT(gated.out, HasSubstr("FAIL"));
  EXPECT_EQ(Json::parse(Read("audit.json"))["verdict"], "FAIL");
  EXPECT_EQ(Audit({"--gate"}).status, 2);
}

TEST_F(CliAudit, AFolderIsNoDatasetButItsFileIsSuggested) {
  const ProgramResult refused = RunHexcal({{"audit", kAudited, "--out=o"}, folder.Path("")});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("(did you mean '" + kAudited + "dataset.yaml'?)"));
}

TEST_F(CliAudit, RefusesWhatIsNotAsItShouldBe) {
  const ProgramResult limit = Audit({"--requirement=" + WithLimit("-1")});
  EXPECT_EQ(limit.status, 3);
  EXPECT_THAT(limit.err, HasSubstr("r.yaml:"));
  EXPECT_THAT(limit.out, IsEmpty());
  const ProgramResult json = Audit({"--previous=" + folder.Write("p.json", "{\"format\": 1}")});
  EXPECT_EQ(json.status, 3);
  EXPECT_THAT(json.err, HasSubstr("p.json:1:"));
  EXPECT_EQ(Audit({"--previous=none.json"}).status, 3);
  EXPECT_EQ(Audit({"--draws=10"}).status, 2);
  EXPECT_EQ(Audit({"--solver=linearized", "--residual=marker"}).status, 2);
  std::filesystem::create_directories(folder.Path("out/neurobot"));
  folder.Write("out/neurobot/report.html", "<html>mine</html>");
  EXPECT_EQ(Audit({"--quiet"}).status, 5);
  folder.Write("out/neurobot/report.html", "<!doctype html>\n<!-- hexcal/report/calibrate/1 -->\n");
  EXPECT_EQ(Audit({"--quiet"}).status, 0);  // another command's
  EXPECT_THAT(Read("report-calibrate.html"), HasSubstr("hexcal/report/calibrate/1"));
}

}  // namespace
}  // namespace hexcal
