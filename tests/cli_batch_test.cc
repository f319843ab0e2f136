// SPDX-License-Identifier: BSD-3-Clause
// hexcal batch from outside: many datasets, a bad one among them, threads, resumption, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
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
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

using Arguments = std::vector<std::string>;

constexpr const char* kRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0.3, 0, 0]
    - [c, 0, 0.05, 0.42, 0, 0.3, 0]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.3]
    - [e, -0.05, 0.03, 0.41, -0.2, 0.2, 0.1]
    - [f, 0.01, -0.04, 0.39, 0.1, -0.3, -0.2]
)";

// Measured as if tool and platform were one and the world the base, but for `dx` in one pose.
std::string DatasetText(const std::string& name, const std::string& dx) {
  std::string measured = kRows;
  measured.replace(measured.find("0.05, 0, 0.4,"), 4, dx);
  return "format: hexcal/dataset/1\nname: " + name +
         "\nunits: {length: m, angle: rad}\nrobot_poses:\n  rows:\n"
         "    - [pose, x, y, z, rx, ry, rz]\n" +
         kRows + "measurement:\n  kind: poses\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
         measured + "  noise: {position: 0.0001, orientation: 0.001}\n";
}

class CliBatch : public ::testing::Test {
 protected:
  CliBatch() {
    for (int i = 0; i < 9; ++i)
      folder.Write("d" + std::to_string(i) + ".yaml",
                   DatasetText("n" + std::to_string(i), "0.0500" + std::to_string(i)));
    folder.Write("m.yaml",
                 "format: hexcal/batch/1\nname: nine\ndatasets: [d*.yaml]\n"
                 "settings: {outliers: reject}\n");
  }

  ProgramResult Run(const Arguments& arguments) const {
    return RunHexcal({arguments, folder.Path("")});
  }

  // What a manifest with these lines is told.
  ProgramResult RunManifest(const std::string& text) const {
    folder.Write("bad.yaml", text);
    const ProgramResult result = Run({"batch", "bad.yaml", "--out=out-bad"});
    EXPECT_FALSE(std::filesystem::exists(folder.Path("out-bad")));
    return result;
  }

  TemporaryFolder folder;
};

TEST_F(CliBatch, CalibratesAllAndSaysSo) {
  const ProgramResult result = Run({"batch", "m.yaml", "--out=out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("done           9"), HasSubstr("failed         0")));
  const std::string csv = folder.Read("out/results.csv");
  EXPECT_THAT(csv, StartsWith("study,idx,status,message,dataset,name,poses,"));
  EXPECT_THAT(csv, HasSubstr("\nnine,8,done,,d8.yaml,n8,6,"));
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.Path("out")))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, UnorderedElementsAre("results.csv", "results.sqlite", "run.json"));
}

// The same numbers as calibrate's, to the last digit.
TEST_F(CliBatch, SaysWhatCalibrateSays) {
  Run({"batch", "m.yaml", "--out=out"});
  Run({"calibrate", "d3.yaml", "--outliers=reject", "--out=one", "--quiet"});
  const std::string json = folder.Read("one/n3/result.json");
  const std::size_t at = json.find("\"rmspe\": ") + 9;
  const std::string rmspe = json.substr(at, json.find(',', at) - at);
  EXPECT_GT(rmspe.size(), 8u);
  EXPECT_THAT(folder.Read("out/results.csv"), HasSubstr("," + rmspe + ","));
}

TEST_F(CliBatch, GivesTheSameBytesForAnyNumberOfThreads) {
  std::string first;
  for (const std::string threads : {"1", "2", "4"}) {
    EXPECT_EQ(Run({"batch", "m.yaml", "--out=out" + threads, "--threads=" + threads}).status, 0);
    const std::string csv = folder.Read("out" + threads + "/results.csv");
    if (first.empty()) first = csv;
    EXPECT_EQ(csv, first);
    EXPECT_GT(csv.size(), 1000u);
  }
}

TEST_F(CliBatch, GoesOnPastABadDataset) {
  folder.Write("d4.yaml", "format: nonsense\n");
  const ProgramResult result = Run({"batch", "m.yaml", "--out=out"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.err, AllOf(HasSubstr("d4.yaml:1:9: found"), HasSubstr("1 of 9 failed")));
  const std::string csv = folder.Read("out/results.csv");
  EXPECT_THAT(csv, HasSubstr("\nnine,4,failed,d4.yaml:1:9: found the format 'nonsense'"));
  EXPECT_THAT(csv, HasSubstr("\nnine,5,done,"));

  // The same where hexcal runs somewhere else.
  folder.Write("x", "");
  const ProgramResult elsewhere =
      RunHexcal({{"batch", folder.Path("m.yaml"), "--out=" + folder.Path("out2")}, "/"});
  EXPECT_EQ(elsewhere.status, 6);
  EXPECT_EQ(folder.Read("out2/results.csv"), csv);

  // Mended, it is done, and the others are left alone.
  folder.Write("d4.yaml", DatasetText("n4", "0.05004"));
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 6);
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out", "--retry"}).status, 0);
  EXPECT_THAT(folder.Read("out/results.csv"), HasSubstr("\nnine,4,done,,d4.yaml,n4,"));
}

TEST_F(CliBatch, CannotBeTrustedWhereADatasetCannot) {
  std::string text = DatasetText("n4", "0.05");
  for (std::size_t at = 0; (at = text.find("0.3, 0, 0]", at)) != std::string::npos;)
    text.replace(at, 3, "0.0");
  for (const char* turn : {"0, 0.3, 0]", "-0.2, 0.2, 0.1]", "0.1, -0.3, -0.2]"})
    for (std::size_t at = 0; (at = text.find(turn, at)) != std::string::npos;)
      text.replace(at, std::string(turn).size(), "0, 0, 0.1]");
  folder.Write("d4.yaml", text);
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 4);
  EXPECT_THAT(folder.Read("out/results.csv"), HasSubstr("\nnine,4,untrusted,"));

  folder.Write(
      "m.yaml",
      "format: hexcal/batch/1\nname: d\ncommand: discover\ndatasets: [d4.yaml, d5.yaml]\n");
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=discovered"}).status, 4);
  EXPECT_THAT(folder.Read("discovered/results.csv"),
              AllOf(HasSubstr("\nd,0,untrusted,"), HasSubstr("\nd,1,done,")));
}

TEST_F(CliBatch, RefusesResultsOfAnotherManifestAndForeignFiles) {
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 0);
  const std::string csv = folder.Read("out/results.csv");
  folder.Write("m.yaml", "format: hexcal/batch/1\nname: nine\ndatasets: [d1.yaml]\n");
  const ProgramResult changed = Run({"batch", "m.yaml", "--out=out"});
  EXPECT_EQ(changed.status, 3);
  EXPECT_THAT(changed.err, HasSubstr("out/results.sqlite: found results of another version"));
  EXPECT_EQ(folder.Read("out/results.csv"), csv);
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out", "--force"}).status, 0);
  EXPECT_THAT(folder.Read("out/results.csv"), HasSubstr("\nnine,0,done,,d1.yaml,"));

  folder.Write("out/results.sqlite", "somebody's text, long enough to be seen as what it is");
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 3);
  EXPECT_THAT(folder.Read("out/results.sqlite"), StartsWith("somebody's"));
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out", "--force"}).status, 0);
  folder.Write("out/results.csv", "a,b\n1,2\n");
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 5);
}

TEST_F(CliBatch, AManifestThatChangesWhatItMatchesIsAnother) {
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 0);
  folder.Write("d9.yaml", DatasetText("n9", "0.05"));
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 3);
}

TEST_F(CliBatch, Discovers) {
  folder.Write("m.yaml",
               "format: hexcal/batch/1\nname: d\ncommand: discover\ndatasets: [d0.yaml, d5.yaml]\n"
               "settings: {bootstraps: 99, alpha: 0.05}\n");
  const ProgramResult result = Run({"batch", "m.yaml", "--out=out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(folder.Read("out/results.csv"), HasSubstr("\nd,1,done,,d5.yaml,n5,6,"));
}

TEST_F(CliBatch, RefusesABadManifestWithItsLine) {
  const std::string head = "format: hexcal/batch/1\nname: x\n";
  const auto expect = [this](const std::string& text, const std::string& message) {
    const ProgramResult result = RunManifest(text);
    EXPECT_EQ(result.status, 3) << text;
    EXPECT_THAT(result.err, HasSubstr("bad.yaml:" + message)) << text;
  };
  expect("format: hexcal/batch/2\nname: x\ndatasets: [d1.yaml]\n", "1:9: found the format");
  expect("format: hexcal/batch/1\nname: a/b\ndatasets: [d1.yaml]\n", "2:7: found the name 'a/b'");
  expect(head + "datasets: []\n", "3:11: found 0 datasets");
  expect(head + "datasets: [e*.yaml]\n", "3:12: found no file like 'e*.yaml'");
  expect(head + "datasets: [d*.yaml, ./d1.yaml]\n", "3:21: found ./d1.yaml again");
  expect(head + "datasets: [[d1.yaml]]\n", "3:12: found");
  expect(head + "dataset: [d1.yaml]\n", "3:1: found the unknown key 'dataset'");
  expect(head + "datasets: [d1.yaml]\ncommand: plan\n", "4:10: found 'plan'");
  expect(head + "datasets: [d1.yaml]\nsettings: {sover: x}\n", "4:12: found");
  expect(head + "datasets: [d1.yaml]\nsettings: {out: x}\n", "4:12: found");
  expect(head + "datasets: [d1.yaml]\nsettings: {solver: x}\n", "4:20: found 'x' for solver");
  expect(head + "datasets: [d1.yaml]\nsettings: {noise_position: 1e-4}\n", "4:12: found");
  expect(head + "datasets: [d1.yaml]\nsettings: {solver: linearized, loss: huber}\n",
         "4:11: --loss");
}

}  // namespace
}  // namespace hexcal
