// SPDX-License-Identifier: BSD-3-Clause
// hexcal schema from outside, and what every command writes held against it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "testing/json_schema.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;
using ::hexcal::testing::Json;
using ::hexcal::testing::JsonOf;
using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::SchemaCheck;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::string kExamples = HEXCAL_EXAMPLES;
const std::string kNeurobot = kExamples + "/neurobot/dataset.yaml";
const std::string kPaper = kExamples + "/paper/dataset.yaml";

ProgramResult Call(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  return RunHexcal({arguments, folder.Path("")});
}

// hexcal/result/1 is of kind result.
std::string KindOf(const Json& document) {
  const std::string format = document.value("format", "");
  const std::size_t slash = format.find('/');
  return slash == std::string::npos ? "" : format.substr(slash + 1, format.rfind('/') - slash - 1);
}

Json SchemaOf(const std::string& kind, const TemporaryFolder& folder) {
  const ProgramResult result = Call({"schema", kind}, folder);
  EXPECT_EQ(result.status, 0) << kind << result.err;
  return Json::parse(result.out);
}

// Every JSON and YAML file below the folder is of a kind that has a schema, and valid; and each of
// these kinds is there.
void ExpectValid(const TemporaryFolder& folder, const std::set<std::string>& kinds) {
  SchemaCheck check;
  std::set<std::string> found;
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder.Path(""))) {
    const std::string extension = entry.path().extension().string(), path = entry.path().string();
    if (extension != ".json" && extension != ".yaml") continue;
    const Json document =
        extension == ".json" ? Json::parse(std::ifstream(path)) : JsonOf(ParseYamlFile(path));
    const std::string kind = KindOf(document);
    if (found.insert(kind).second) check.AddSchema(kind, SchemaOf(kind, folder));
    check.Add(kind, document);
    paths.push_back(path);
  }
  const std::vector<std::string> verdicts = check.Judge();
  for (std::size_t i = 0; i < paths.size(); ++i) EXPECT_EQ(verdicts[i], "") << paths[i];
  EXPECT_EQ(found, kinds);
}

TEST(CliSchema, ListsThemAndPrintsEach) {
  const TemporaryFolder folder;
  const ProgramResult list = Call({"schema"}, folder);
  EXPECT_EQ(list.status, 0);
  for (const char* kind : {"dataset",
                           "model",
                           "settings",
                           "requirement",
                           "result",
                           "discovery",
                           "audit",
                           "compare",
                           "plan",
                           "run"}) {
    EXPECT_THAT(list.out, HasSubstr(std::string(kind) + "  ")) << kind;
    const Json schema = SchemaOf(kind, folder);
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    EXPECT_EQ(schema["type"], "object");
  }
}

TEST(CliSchema, SettingsAreThoseOfACommand) {
  const TemporaryFolder folder;
  const Json all = SchemaOf("settings", folder);
  const Json own = Json::parse(Call({"schema", "settings", "simulate"}, folder).out);
  EXPECT_EQ(own["properties"]["seed"]["minimum"], 0);
  EXPECT_FALSE(own["properties"].contains("solver"));
  EXPECT_EQ(all["properties"]["solver"]["enum"], Json({"nonlinear", "linearized"}));
}

TEST(CliSchema, RefusesWrongUsage) {
  const TemporaryFolder folder;
  const ProgramResult kind = Call({"schema", "datset"}, folder);
  EXPECT_EQ(kind.status, 2);
  EXPECT_THAT(kind.err, HasSubstr("(did you mean 'dataset'?)"));
  EXPECT_EQ(Call({"schema", "settings", "none"}, folder).status, 2);
  EXPECT_EQ(Call({"schema", "dataset", "calibrate"}, folder).status, 2);
}

TEST(CliSchema, HoldsForWhatCalibrateWrites) {
  const TemporaryFolder folder;
  const auto calibrate = [&folder](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"calibrate", "--out=" + out});
    const ProgramResult result = Call(more, folder);
    EXPECT_EQ(result.status, 0) << result.err;
  };
  calibrate("a", {kNeurobot, kPaper});
  calibrate("b", {kPaper, "--solver=linearized", "--error=twist"});
  calibrate("c", {kNeurobot, "--residual=pose", "--outliers=reject", "--loss=huber"});
  calibrate("d", {kExamples + "/hidden-effect/dataset.yaml", "--outliers=reject"});
  const std::string tilts = folder.Write(
      "dataset.yaml",  // turns about one axis: not all of the 12 are determined
      "format: hexcal/dataset/1\nname: turns\nunits: {length: m, angle: rad}\nrobot_poses:\n  "
      "rows: "
      "[[pose,x,y,z,rx,ry,rz], [1,0,0,0.1,0,0,0], [2,0,0,0.1,0,0,0.1], [3,0,0,0.1,0,0,0.3], "
      "[4,0,0,0.1,0,0,0.5]]\nmeasurement:\n  kind: poses\n  noise: {position: 0.001, orientation: "
      "0.001}\n  rows: [[pose,x,y,z,rx,ry,rz], [1,0,0,0.1,0,0,0], [2,0,0,0.1,0,0,0.1], "
      "[3,0,0,0.1,0,0,0.3], [4,0,0,0.1,0,0,0.5]]\n");
  EXPECT_EQ(Call({"calibrate", tilts, "--out=e"}, folder).status, 4);
  ExpectValid(folder, {"dataset", "model", "result", "run"});
}

TEST(CliSchema, HoldsForWhatCompareAndAuditWrite) {
  const TemporaryFolder folder;
  for (const std::string& dataset : {kNeurobot, kPaper})
    Call({"compare", dataset, "--out=a", "--draws=1000", "--starts=1"}, folder);
  EXPECT_EQ(Call({"calibrate", kNeurobot, "--history=h.sqlite", "--out=b"}, folder).status, 0);
  const ProgramResult audit = Call({"audit",
                                    kNeurobot,
                                    "--requirement=" + kExamples + "/neurobot/requirement.yaml",
                                    "--previous=b/neurobot/result.json",
                                    "--draws=1000",
                                    "--history=h.sqlite",
                                    "--out=c"},
                                   folder);
  EXPECT_EQ(audit.status, 0) << audit.err;
  Call({"audit", kPaper, "--draws=1000", "--out=c"}, folder);
  ExpectValid(folder, {"audit", "compare", "model", "result", "run"});
}

TEST(CliSchema, HoldsForWhatDiscoverPlanAndSimulateWrite) {
  const TemporaryFolder folder;
  const std::string hidden = kExamples + "/hidden-effect/dataset.yaml";
  const ProgramResult found =
      Call({"discover", hidden, "--bootstraps=99", "--alpha=0.05", "--folds=2", "--out=a"}, folder);
  ASSERT_EQ(found.status, 0) << found.err;
  const std::string model = "--model=a/hidden-effects-8/model.yaml";
  EXPECT_EQ(Call({"plan", hidden, model, "--for=parameters", "--out=b.json"}, folder).status, 0);
  EXPECT_EQ(Call({"plan", hidden, model, "--for=rivals", "--out=c.json"}, folder).status, 0);
  EXPECT_EQ(Call({"simulate", hidden, model, "--out=d"}, folder).status, 0);
  EXPECT_EQ(Call({"calibrate", hidden, model, "--out=e"}, folder).status, 0);
  ExpectValid(folder, {"dataset", "discovery", "model", "plan", "result", "run"});
}

TEST(CliSchema, HoldsForWhatAModelWithEffectsLeadsTo) {
  const TemporaryFolder folder;
  std::ostringstream truth;
  truth << std::ifstream(kExamples + "/neurobot/truth.yaml").rdbuf()
        << "effects: [{name: tracker_scale, parameters: {scale: 0.001}}]\n";
  folder.Write("m.yaml", truth.str());
  const std::string model = "--model=m.yaml", dataset = "a/neurobot/dataset.yaml";
  EXPECT_EQ(Call({"simulate", kNeurobot, model, "--out=a"}, folder).status, 0);
  EXPECT_EQ(Call({"audit", dataset, model, "--draws=1000", "--folds=2", "--out=b"}, folder).status,
            0);
  const ProgramResult found =
      Call({"discover", dataset, model, "--bootstraps=99", "--alpha=0.05", "--folds=2", "--out=c"},
           folder);
  EXPECT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("given          tracker_scale"));
  EXPECT_THAT(folder.Read("c/neurobot/report.html"), HasSubstr("What was given"));
  ExpectValid(folder, {"audit", "dataset", "discovery", "model", "result", "run"});
  std::string map =
      "pose_map:\n  degree: 1\n  reference: {xyz: [0, 0, 0.2], quaternion: [1, 0, 0, 0]}\n"
      "  box: {centre: [0, 0, 0, 0, 0, 0], half_width: [1, 1, 1, 1, 1, 1]}\n  coefficients:\n";
  for (int k = 0; k < 6; ++k) map += "    - [0, 0, 0, 0, 0, 0, 0]\n";
  folder.Write("map.yaml", truth.str() + map);
  const ProgramResult refused = Call({"discover", dataset, "--model=map.yaml", "--out=d"}, folder);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("a pose map is none"));
}

TEST(CliSchema, HoldsForWhatPivotWrites) {
  const TemporaryFolder folder;
  EXPECT_EQ(Call({"pivot", kExamples + "/pivot/pivoting.yaml", "--out=a"}, folder).status, 0);
  ExpectValid(folder, {"pivot", "run"});
}

TEST(CliSchema, HoldsForWhatImportWrites) {
  const TemporaryFolder folder;
  const ProgramResult imported = Call({"import",
                                       "ndi_csv",
                                       kExamples + "/ndi-and-pi/tracker.csv",
                                       "--robot=" + kExamples + "/ndi-and-pi/hexapod.dat",
                                       "--base=0x0A",
                                       "--tool=0x0B",
                                       "--pair=rows",
                                       "--out=mine"},
                                      folder);
  ASSERT_EQ(imported.status, 0) << imported.err;
  ExpectValid(folder, {"dataset"});
}

TEST(CliSchema, HoldsForWhatFileMakersPrint) {
  const TemporaryFolder folder;
  ASSERT_EQ(Call({"calibrate", kNeurobot, "--out=a"}, folder).status, 0);
  const std::string model = "--model=a/neurobot/model.yaml";
  SchemaCheck check;
  check.AddSchema("written", SchemaOf("written", folder));
  const std::vector<std::vector<std::string>> calls = {
      {"predict", kNeurobot, model, "--out=where.csv"},
      {"simulate", kNeurobot, model, "--out=s"},
      {"export", "ros2", "a/neurobot/result.json", "--out=x"},
      {"init", "--out=i"},
      {"import",
       "ndi_csv",
       kExamples + "/ndi-and-pi/tracker.csv",
       "--robot=" + kExamples + "/ndi-and-pi/hexapod.dat",
       "--base=0x0A",
       "--tool=0x0B",
       "--pair=rows",
       "--out=m"}};
  for (std::vector<std::string> call : calls) {
    call.push_back("--json");
    const ProgramResult result = Call(call, folder);
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["command"], call[0]);
    for (const Json& file : json["files"])
      EXPECT_FALSE(folder.Read(file.get<std::string>()).empty()) << file;
    check.Add("written", json);
  }
  EXPECT_THAT(check.Judge(), ::testing::ElementsAre("", "", "", "", ""));
}

TEST(CliSchema, HoldsForWhatHistoryPrints) {
  const TemporaryFolder folder;
  const std::string truth = "--model=" + kExamples + "/neurobot/truth.yaml";
  for (const char* seed : {"1", "2", "3", "4", "5", "5"}) {
    const std::string out = std::string("s") + seed;
    // Records are dated to the second, and a drift takes two dates.
    if (out == "s3") std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    Call({"simulate", kNeurobot, truth, "--seed=" + std::string(seed), "--out=" + out}, folder);
    const ProgramResult kept = Call(
        {"calibrate", out + "/neurobot/dataset.yaml", "--history=h.sqlite", "--out=c"}, folder);
    ASSERT_EQ(kept.status, 0) << kept.err;
  }
  Call({"calibrate", "s1/neurobot/dataset.yaml", "--loss=huber", "--history=h.sqlite", "--out=c"},
       folder);
  SchemaCheck check;
  std::string trend;
  for (const std::vector<std::string>& call : {std::vector<std::string>{"list", "h.sqlite"},
                                               {"show", "h.sqlite", "2"},
                                               {"trend", "h.sqlite"},
                                               {"verify", "h.sqlite"}}) {
    std::vector<std::string> words = {"history", "--json"};
    words.insert(words.end(), call.begin(), call.end());
    const ProgramResult result = Call(words, folder);
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out);
    check.AddSchema(KindOf(json), SchemaOf(KindOf(json), folder));
    check.Add(KindOf(json), json);
    if (call[0] == "trend") trend = result.out;
  }
  EXPECT_THAT(check.Judge(), ::testing::ElementsAre("", "", "", ""));
  for (const char* part :
       {"same_readings_as\":5", "drift\":{", "moving_mean\":{", "made_otherwise\":[{"})
    EXPECT_THAT(trend, HasSubstr(part));
}

TEST(CliSchema, HoldsForWhatBatchPrints) {
  const TemporaryFolder folder;
  const ProgramResult result =
      Call({"batch", kExamples + "/batch/datasets.yaml", "--json", "--out=b"}, folder);
  ASSERT_EQ(result.status, 0) << result.err;
  SchemaCheck check;
  check.AddSchema("batch-counts", SchemaOf("batch-counts", folder));
  check.Add("batch-counts", Json::parse(result.out));
  EXPECT_THAT(check.Judge(), ::testing::ElementsAre(""));
}

// What goes to stdout is what goes to the file.
TEST(CliSchema, HoldsForJsonOnStdout) {
  const TemporaryFolder folder;
  const ProgramResult result = Call({"calibrate", kPaper, "--json", "--out=a"}, folder);
  SchemaCheck check;
  check.AddSchema("result", SchemaOf("result", folder));
  check.Add("result", Json::parse(result.out));
  EXPECT_THAT(check.Judge(), ::testing::ElementsAre(""));
}

}  // namespace
}  // namespace hexcal
