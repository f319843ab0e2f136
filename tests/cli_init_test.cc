// SPDX-License-Identifier: BSD-3-Clause
// hexcal init from outside: a dataset that the other commands take as it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

ProgramResult Call(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  return RunHexcal({arguments, folder.Path("")});
}

TEST(CliInit, CalibrateTakesWhatItWritesAsItIs) {
  for (const std::string kind : {"markers", "poses"}) {
    const TemporaryFolder folder;
    const ProgramResult made = Call({"init", "--kind=" + kind, "--out=mine"}, folder);
    ASSERT_EQ(made.status, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("mine/dataset.yaml\n"));
    const ProgramResult calibrated = Call({"calibrate", "mine/dataset.yaml", "--out=out"}, folder);
    EXPECT_EQ(calibrated.status, 0) << calibrated.err;
    EXPECT_THAT(calibrated.err, IsEmpty());
    const Json result = Json::parse(folder.Read("out/mine/result.json"));
    EXPECT_EQ(result["poses"].size(), 12u);
    // Simulated so: T_B^W and T_T^A, m. The noise that it states is the one that it has.
    const std::vector<double> base = result["world_from_base"]["xyz"],
                              tool = result["platform_from_tool"]["xyz"],
                              sigma = result["standard_deviation"];
    const double base_truth[] = {0.1012, 0.0735, -0.0521}, tool_truth[] = {0.0013, -0.0024, 0.0508};
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(base[i], base_truth[i], 4 * sigma[i]);
      EXPECT_NEAR(tool[i], tool_truth[i], 4 * sigma[6 + i]);
    }
    EXPECT_NEAR(result["noise_scale"], 1.0, 0.2);
  }
}

// Live or commented out.
TEST(CliInit, ExplainsEveryKeyOfADataset) {
  const TemporaryFolder folder;
  ASSERT_EQ(Call({"init", "--out=mine"}, folder).status, 0);
  const std::string text = folder.Read("mine/dataset.yaml");
  const Json schema = Json::parse(Call({"schema", "dataset"}, folder).out);
  for (const auto& [key, value] : schema["properties"].items())
    EXPECT_TRUE(text.find("\n" + key + ":") != std::string::npos ||
                text.find("\n# " + key + ":") != std::string::npos)
        << key;
  EXPECT_THAT(text, HasSubstr("Rx(rx) Ry(ry) Rz(rz)"));
}

TEST(CliInit, ReplacesNothingOfOthers) {
  const TemporaryFolder folder;
  EXPECT_EQ(Call({"init", "--out=mine", "--quiet"}, folder).out, "");
  EXPECT_EQ(Call({"init", "--out=mine", "--name=bench-3"}, folder).status, 0);
  EXPECT_THAT(folder.Read("mine/dataset.yaml"), HasSubstr("\nname: \"bench-3\"\n"));
  folder.Write("mine/dataset.yaml", "format: hexcal/dataset/1\n");
  EXPECT_EQ(Call({"init", "--out=mine"}, folder).status, 5);
  EXPECT_EQ(Call({"init", "--out=mine", "--name=a b"}, folder).status, 2);
  const ProgramResult file = Call({"init", "file"}, folder);
  EXPECT_EQ(file.status, 2);
  EXPECT_THAT(file.err,
              HasSubstr("found 'file', expected no file (where the files go is --out=DIR)"));
  EXPECT_EQ(Call({"init"}, folder).status, 2);
}

// The files are made to be worked on.
TEST(CliInit, ReplacesNothingThatWasWorkedOn) {
  for (const std::string file : {"mine/dataset.yaml", "mine/poses.csv", "mine/markers.csv"}) {
    const TemporaryFolder folder;
    ASSERT_EQ(Call({"init", "--out=mine"}, folder).status, 0);
    std::string text = folder.Read(file);
    text[text.size() - 2] = text[text.size() - 2] == '1' ? '2' : '1';  // the last digit or letter
    folder.Write(file, text);
    const ProgramResult refused = Call({"init", "--out=mine"}, folder);
    EXPECT_EQ(refused.status, 5) << file;
    EXPECT_THAT(refused.err, HasSubstr("was changed since hexcal wrote it (--force replaces it)"));
    EXPECT_EQ(folder.Read(file), text);
    EXPECT_EQ(Call({"init", "--out=mine", "--force"}, folder).status, 0) << file;
    EXPECT_NE(folder.Read(file), text);
  }
}

}  // namespace
}  // namespace hexcal
