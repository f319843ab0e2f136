// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit from outside. What it decides is tested with the report.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <array>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Json = nlohmann::json;

const std::string kExample = std::string(HEXCAL_EXAMPLES) + "/neurobot/";

class CliAudit : public ::testing::Test {
 protected:
  ProgramResult Audit(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "audit", kExample + "dataset.yaml", "--out=out", "--draws=1000", "--folds=2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunHexcal({arguments, folder.Path("")});
  }

  std::string Read(const std::string& name) const { return folder.Read("out/neurobot/" + name); }

  // The bundled requirement with another limit, mm.
  std::string WithLimit(const std::string& limit) const {
    std::string text = Bundled();
    const std::string part = "limit: 0.5";
    text.replace(text.find(part), part.size(), "limit: " + limit);
    return folder.Write("r.yaml", text);
  }

  static std::string Bundled() {
    std::ostringstream content;
    content << std::ifstream(kExample + "requirement.yaml").rdbuf();
    return content.str();
  }

  const std::string bundled = "--requirement=" + kExample + "requirement.yaml";
  TemporaryFolder folder;
};

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

// The solutions side by side are those that calibrate finds alone.
TEST_F(CliAudit, TheReportHasTheEstimatesOfEachSolution) {
  ASSERT_EQ(Audit({}).status, 0);
  std::string row = "<td>base x, mm</td>";
  const std::array<std::vector<std::string>, 3> ways = {{{"--residual=marker"},  // the audit's own
                                                         {"--residual=pose"},
                                                         {"--solver=linearized"}}};
  for (const std::vector<std::string>& way : ways) {
    std::vector<std::string> args = {"calibrate", kExample + "dataset.yaml", "--out=c"};
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

// Half a millimetre in one marker of one pose: page, table, audit.json and calibrate name it.
TEST_F(CliAudit, NamesABadReadingOfOneMarker) {
  std::string rows;
  std::ifstream in(kExample + "markers.csv");
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
    std::filesystem::copy_file(kExample + name, folder.Path(name));
  const ProgramResult found = RunHexcal({{"audit",
                                          "dataset.yaml",
                                          "--requirement=" + kExample + "requirement.yaml",
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
  EXPECT_THAT(Read("report.html"), HasSubstr("dataset.yaml --out="));
  EXPECT_THAT(Read("report.html"), HasSubstr("--folds=2"));
  EXPECT_THAT(Read("report.html"), HasSubstr("--operator=&#39;second shift&#39;"));
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

TEST_F(CliAudit, WritesTheSameBytesWhateverTheThreads) {
  ASSERT_EQ(Audit({bundled, "--threads=1", "--quiet"}).status, 0);
  std::vector<std::string> once;
  for (const char* name : {"audit.json", "result.json", "model.yaml"}) once.push_back(Read(name));
  const ProgramResult again = Audit({bundled, "--threads=3", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  int i = 0;
  for (const char* name : {"audit.json", "result.json", "model.yaml"})
    EXPECT_EQ(Read(name), once[i++]) << name;
  EXPECT_EQ(Json::parse(again.out), Json::parse(Read("audit.json")));
}

// Against its own result nothing has changed, and nothing is tested: no reading is a new one.
TEST_F(CliAudit, TestsNoChangeBetweenResultsOfTheSameReadings) {
  ASSERT_EQ(Audit({"--quiet"}).status, 0);
  const std::string earlier = folder.Write("earlier.json", Read("result.json"));
  const ProgramResult result = Audit({"--residual=pose", "--previous=" + earlier});
  ASSERT_EQ(result.status, 0);
  const Json audit = Json::parse(Read("audit.json"));
  EXPECT_EQ(audit["verdict"], "none");
  const Json change = audit["change"];
  EXPECT_TRUE(change["p_value"].is_null() && change["chi_square"].is_null());
  EXPECT_TRUE(change["sigmas"][0].is_null());
  EXPECT_LT(std::abs(change["over_own"][0].get<double>()), 1.0);
  EXPECT_EQ(change["shared_readings"],
            Json::parse(R"({"known": true, "poses": 60, "of": 60, "earlier_of": 60})"));
  EXPECT_THAT(Read("report.html"),
              AllOf(HasSubstr("Change since an earlier calibration"),
                    HasSubstr("the very same readings of 60 poses"),
                    HasSubstr("no probability is given")));
  EXPECT_THAT(result.out, HasSubstr("60 poses have the same readings in both"));
}

// Of other readings of another machine: all has changed.
TEST_F(CliAudit, ComparesWithAnEarlierResultOfOtherReadings) {
  const ProgramResult other =
      RunHexcal({{"calibrate",
                  std::string(HEXCAL_EXAMPLES) + "/neurobot-test/dataset.yaml",
                  "--out=other",
                  "--quiet"},
                 folder.Path("")});
  ASSERT_EQ(other.status, 0) << other.err;
  ASSERT_EQ(Audit({"--quiet", "--previous=other/neurobot-test/result.json"}).status, 0);
  Json change = Json::parse(Read("audit.json"))["change"];
  EXPECT_EQ(change["shared_readings"]["known"], true);
  EXPECT_EQ(change["shared_readings"]["poses"], 0);
  EXPECT_GE(change["p_value"].get<double>(), 0.0);
  // One that does not say which readings it used, as hexcal wrote them once.
  std::string old = folder.Read("other/neurobot-test/result.json");
  for (std::size_t at; (at = old.find(",\"readings\":")) != std::string::npos;) old.erase(at, 30);
  ASSERT_EQ(Audit({"--quiet", "--previous=" + folder.Write("old.json", old)}).status, 0);
  change = Json::parse(Read("audit.json"))["change"];
  EXPECT_EQ(change["shared_readings"]["known"], false);
  EXPECT_FALSE(change["p_value"].is_null());
  EXPECT_THAT(Read("report.html"), HasSubstr("does not say which readings it used"));
}

TEST_F(CliAudit, AFolderIsNoDatasetButItsFileIsSuggested) {
  const ProgramResult refused = RunHexcal({{"audit", kExample, "--out=o"}, folder.Path("")});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("(did you mean '" + kExample + "dataset.yaml'?)"));
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
}

}  // namespace
}  // namespace hexcal
