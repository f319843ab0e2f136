// SPDX-License-Identifier: BSD-3-Clause
// hexcal history and --history from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/digest.h"
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
using ::testing::Not;
using Json = nlohmann::json;

const std::string kExample = std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml";
const std::string kOther = std::string(HEXCAL_EXAMPLES) + "/paper/dataset.yaml";

class CliHistory : public ::testing::Test {
 protected:
  ProgramResult Run(const std::vector<std::string>& arguments) const {
    return RunHexcal({arguments, folder.Path("")});
  }
  ProgramResult Calibrate(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {
        "calibrate", kExample, "--out=out", "--history=h.sqlite", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Run(arguments);
  }
  Json RunRecord() const { return Json::parse(folder.Read("out/neurobot/run.json")); }
  Json Ask(const std::vector<std::string>& words) const {
    std::vector<std::string> arguments = words;
    arguments.insert(arguments.begin(), "history");
    arguments.push_back("--json");
    const ProgramResult result = Run(arguments);
    return Json::parse(result.out, nullptr, false);
  }

  // A later measurement of the machine, simulated from the model that a calibration has left.
  std::string Measure(int seed) const {
    const std::string out = "sim" + std::to_string(seed);
    EXPECT_EQ(Run({"simulate",
                   kExample,
                   "--model=first/neurobot/model.yaml",
                   "--out=" + out,
                   "--seed=" + std::to_string(seed),
                   "--quiet"})
                  .status,
              0);
    return out + "/neurobot/dataset.yaml";
  }

  TemporaryFolder folder;
};

TEST_F(CliHistory, KeepsWhatWasCalibratedByWhom) {
  ASSERT_EQ(Calibrate({"--operator=A. <b>Body</b>"}).status, 0);
  const std::string head = RunRecord()["history"]["head"];
  EXPECT_EQ(RunRecord()["history"]["record"], 1);
  ASSERT_EQ(Calibrate().status, 0);
  const Json list = Ask({"list", "h.sqlite"});
  ASSERT_EQ(list["records"].size(), 2u);
  EXPECT_EQ(list["records"][0]["hash"], head);
  EXPECT_EQ(list["records"][0]["operator"], "A. <b>Body</b>");
  EXPECT_EQ(list["records"][1]["dataset"], "neurobot");
  EXPECT_EQ(list["head"], RunRecord()["history"]["head"]);
  const Json record = Ask({"show", "h.sqlite", "1"})["record"];
  const Json result = Json::parse(folder.Read("out/neurobot/result.json"));
  EXPECT_EQ(record["covariance"], result["covariance"]);
  EXPECT_EQ(record["world_from_base"]["xyz"], result["world_from_base"]["xyz"]);
  EXPECT_EQ(record["platform_from_tool"]["quaternion"], result["platform_from_tool"]["quaternion"]);
  ASSERT_EQ(record["inputs"].size(), 3u);
  EXPECT_EQ(record["inputs"][0]["sha256"], HashFiles({kExample})[0].sha256);
  EXPECT_EQ(record["readings_sha256"], record["inputs"][2]["sha256"]);
  EXPECT_EQ(record["result_sha256"], Sha256(folder.Read("out/neurobot/result.json")));
  // The same readings twice are one measurement.
  const Json trend = Ask({"trend", "h.sqlite"})["datasets"][0];
  EXPECT_FALSE(trend["records"][1]["used"].get<bool>());
  EXPECT_EQ(trend["records"][1]["same_readings_as"], 1);
  EXPECT_EQ(trend["in_control"], 1);
  EXPECT_EQ(record["settings"]["solver"], "nonlinear");
  EXPECT_EQ(record["revision"], RunRecord()["revision"]);
  EXPECT_THAT(Run({"history", "list", "h.sqlite"}).out,
              AllOf(HasSubstr("neurobot"), HasSubstr(head.substr(0, 12)), HasSubstr("<b>Body")));
  EXPECT_THAT(Run({"history", "show", "h.sqlite", "2"}).out,
              AllOf(HasSubstr("record 2"), HasSubstr(head), HasSubstr("base.dx")));
}

TEST_F(CliHistory, TheAuditPrintsTheHeadAndTheChangeLog) {
  ASSERT_EQ(Calibrate({"--operator=<script>1</script>"}).status, 0);
  const ProgramResult audit = Run({"audit",
                                   kExample,
                                   "--out=out",
                                   "--history=h.sqlite",
                                   "--draws=1000",
                                   "--folds=2",
                                   "--quiet",
                                   "--force"});
  ASSERT_EQ(audit.status, 0) << audit.err;
  const std::string head = RunRecord()["history"]["head"];
  const Json json = Json::parse(folder.Read("out/neurobot/audit.json"));
  EXPECT_EQ(json["history"]["head"], head);
  EXPECT_EQ(json["history"]["records"].size(), 2u);
  EXPECT_THAT(folder.Read("out/neurobot/report.html"),
              AllOf(HasSubstr("Change log"),
                    HasSubstr(head),
                    HasSubstr("&lt;script&gt;1"),
                    HasSubstr("the readings of record 1"),
                    Not(HasSubstr("<script>1"))));
  EXPECT_EQ(Run({"history", "verify", "h.sqlite", "--head=" + head}).status, 0);
  // The report's number is that of the same audit without a history.
  ASSERT_EQ(Run({"audit", kExample, "--out=out", "--draws=1000", "--folds=2", "--quiet"}).status,
            0);
  const Json without = Json::parse(folder.Read("out/neurobot/audit.json"));
  EXPECT_EQ(without["id"], json["id"]);
  EXPECT_FALSE(without.contains("history"));
}

// Four measurements of a machine that stands still, and one of another tool.
TEST_F(CliHistory, TrendSaysWhichRecordIsOutOfControlAndWhere) {
  ASSERT_EQ(Run({"calibrate", kExample, "--out=first", "--quiet"}).status, 0);
  for (int seed = 1; seed <= 4; ++seed)
    ASSERT_EQ(
        Run({"calibrate", Measure(seed), "--out=out", "--history=h.sqlite", "--quiet"}).status, 0);
  std::string model = folder.Read("first/neurobot/model.yaml");
  const std::size_t tool = model.find("platform_from_tool:");
  const std::size_t x = model.find("xyz: [", tool) + 6;
  model.replace(x, model.find(',', x) - x, "0.0002");
  folder.Write("first/neurobot/model.yaml", model);
  ASSERT_EQ(Run({"calibrate", Measure(5), "--out=out", "--history=h.sqlite", "--quiet"}).status, 0);
  const Json trend = Ask({"trend", "h.sqlite"})["datasets"][0];
  for (int i = 1; i < 4; ++i) EXPECT_TRUE(trend["records"][i]["in_control"].get<bool>()) << i;
  EXPECT_FALSE(trend["records"][4]["in_control"].get<bool>());
  EXPECT_THAT(trend["records"][4]["level"]["outside"].get<std::vector<std::string>>(),
              ::testing::Contains("tool.dx"));
  const ProgramResult text = Run({"history", "trend", "h.sqlite", "--dataset=neurobot"});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(text.out, AllOf(HasSubstr("OUT OF CONTROL: "), HasSubstr("tool.dx +")));
  // A new chart after a change that is known.
  EXPECT_THAT(Run({"history", "trend", "h.sqlite", "--since=5"}).out, Not(HasSubstr("OUT OF")));
  EXPECT_EQ(Run({"history", "trend", "h.sqlite", "--dataset=none"}).status, 3);
  const ProgramResult none = Run({"history", "list", "h.sqlite", "--dataset=none"});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("no record of dataset 'none'"));
}

TEST_F(CliHistory, VerifyFindsAChangedByte) {
  ASSERT_EQ(Calibrate().status, 0);
  const ProgramResult fine = Run({"history", "verify", "h.sqlite"});
  EXPECT_EQ(fine.status, 0);
  EXPECT_THAT(fine.out, HasSubstr("1 record, each as it was written"));
  EXPECT_THAT(fine.err, IsEmpty());
  std::string bytes = folder.Read("h.sqlite");
  const std::size_t at = bytes.find("\"noise_scale\":") + 15;
  bytes[at] = bytes[at] == '9' ? '8' : '9';
  folder.Write("h.sqlite", bytes);
  const ProgramResult changed = Run({"history", "verify", "h.sqlite"});
  EXPECT_EQ(changed.status, 3);
  EXPECT_THAT(changed.out, HasSubstr("record 1: its text or its hash was changed"));
  EXPECT_THAT(changed.err, HasSubstr("h.sqlite"));
  EXPECT_FALSE(Ask({"verify", "h.sqlite"})["intact"].get<bool>());
  EXPECT_EQ(Run({"history", "list", "h.sqlite"}).status, 3);
  // Nothing is appended to it, nor computed for it.
  const ProgramResult refused = Calibrate();
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("record 1 changed after it was written"));
  EXPECT_EQ(folder.Read("h.sqlite"), bytes);
}

TEST_F(CliHistory, ABadHistoryShowsBeforeAnythingIsComputed) {
  folder.Write("h.sqlite", "notes of mine");
  const ProgramResult foreign = Calibrate();
  EXPECT_EQ(foreign.status, 3);
  EXPECT_THAT(foreign.err, HasSubstr("h.sqlite"));
  EXPECT_FALSE(std::filesystem::exists(folder.Path("out")));
  EXPECT_EQ(folder.Read("h.sqlite"), "notes of mine");
  folder.Write("file", "");
  EXPECT_EQ(Calibrate({"--history=file/h.sqlite"}).status, 2);  // given twice
  EXPECT_EQ(Run({"calibrate", kExample, "--out=out", "--history=file/h.sqlite"}).status, 5);
  EXPECT_FALSE(std::filesystem::exists(folder.Path("out")));
}

// The results would replace it.
TEST_F(CliHistory, CannotBeOneOfTheResults) {
  const ProgramResult result =
      Run({"calibrate", kExample, "--out=out", "--history=out/neurobot/result.json", "--quiet"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("out/neurobot/result.json: "));
  EXPECT_TRUE(Json::accept(folder.Read("out/neurobot/result.json")));
}

TEST_F(CliHistory, SeveralDatasetsGoToOneHistory) {
  const std::vector<std::string> both = {
      "calibrate", kExample, kOther, "--out=out", "--history=out/h.sqlite", "--quiet"};
  const ProgramResult first = Run(both);
  ASSERT_EQ(first.status, 0);
  EXPECT_THAT(first.err, HasSubstr("its folder is not there yet: a new history begins in it"));
  const Json list = Ask({"list", "out/h.sqlite"});
  ASSERT_EQ(list["records"].size(), 2u);
  EXPECT_NE(list["records"][0]["dataset"], list["records"][1]["dataset"]);
  EXPECT_EQ(Ask({"trend", "out/h.sqlite"})["datasets"].size(), 2u);
  EXPECT_EQ(Ask({"list", "out/h.sqlite", "--dataset=neurobot"})["records"].size(), 1u);
}

TEST_F(CliHistory, RefusesWrongUsage) {
  ASSERT_EQ(Calibrate().status, 0);
  const ProgramResult word = Run({"history", "lst", "h.sqlite"});
  EXPECT_EQ(word.status, 2);
  EXPECT_THAT(word.err, HasSubstr("did you mean 'list'?"));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"history"},
        {"history", "list"},
        {"history", "show", "h.sqlite"},
        {"history", "show", "h.sqlite", "one"},
        {"history", "list", "h.sqlite", "1"},
        {"history", "list", "h.sqlite", "--head=" + std::string(64, 'a')},
        {"history", "verify", "h.sqlite", "--head=abc"},
        {"history", "verify", "h.sqlite", "--since=2"},
        {"calibrate", kExample, "--out=out", "--operator=x"}})
    EXPECT_EQ(Run(arguments).status, 2) << arguments.back();
  EXPECT_EQ(Run({"history", "show", "h.sqlite", "2"}).status, 3);
  EXPECT_EQ(Run({"history", "list", "none.sqlite"}).status, 3);
  const ProgramResult other =
      Run({"history", "verify", "h.sqlite", "--head=" + std::string(64, 'a')});
  EXPECT_EQ(other.status, 3);
  EXPECT_THAT(other.out, HasSubstr("the end was cut off"));
}

}  // namespace
}  // namespace hexcal
