// SPDX-License-Identifier: BSD-3-Clause
// hexcal discover from outside. What it finds is tested with discovery.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Json = nlohmann::json;

const std::string kDataset = std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml";

class CliDiscover : public testing::CliTest {
 protected:
  ProgramResult Discover(const std::vector<std::string>& more) const {
    return Call({"discover", kDataset, "--out=out", "--bootstraps=99", "--folds=2"}, more);
  }

  std::string Read(const std::string& name) const { return folder.Read("out/neurobot/" + name); }
};

TEST_F(CliDiscover, LeavesItsFilesAndSaysWhatIsInThem) {
  const ProgramResult result = Discover({});
  EXPECT_EQ(result.status, 0) << result.err;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.Path("out/neurobot")))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names,
              UnorderedElementsAre(
                  "discovery.json", "result.json", "model.yaml", "run.json", "report.html"));

  const Json discovery = Json::parse(Read("discovery.json"));
  EXPECT_EQ(discovery["format"], "hexcal/discovery/1");
  EXPECT_EQ(discovery["dataset"], "neurobot");
  EXPECT_EQ(discovery["settings"]["bootstraps"], 99);
  EXPECT_EQ(discovery["poses"].size(), 60u);
  const std::string verdict = discovery["verdict"];
  EXPECT_THAT(result.out, HasSubstr("neurobot: 60 poses, " + verdict));
  EXPECT_THAT(result.out, HasSubstr("written to     out/neurobot"));
  EXPECT_THAT(Read("report.html"), HasSubstr("<strong>" + verdict + "</strong>"));

  const Json fitted = Json::parse(Read("result.json"));
  EXPECT_EQ(fitted["residual"], "marker");
  EXPECT_EQ(fitted["effects"].size(), discovery["effects"].size());
  EXPECT_EQ(Json::parse(Read("run.json"))["settings"]["folds"], "2");
  const ProgramResult predicted =
      Call({"predict", kDataset, "--model=out/neurobot/model.yaml", "--out=p.csv"});
  EXPECT_EQ(predicted.status, 0) << predicted.err;
}

TEST_F(CliDiscover, WritesTheSameBytesWhateverTheThreads) {
  ASSERT_EQ(Discover({"--threads=1", "--quiet"}).status, 0);
  std::vector<std::string> once;
  for (const char* name : {"discovery.json", "result.json", "model.yaml"})
    once.push_back(Read(name));
  const ProgramResult again = Discover({"--threads=3", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  int i = 0;
  for (const char* name : {"discovery.json", "result.json", "model.yaml"})
    EXPECT_EQ(Read(name), once[i++]) << name;
  EXPECT_EQ(Json::parse(again.out), Json::parse(Read("discovery.json")));
}

TEST_F(CliDiscover, ReplacesItsOwnReportAndNoOther) {
  std::filesystem::create_directories(folder.Path("out/neurobot"));
  folder.Write("out/neurobot/report.html", "<html>mine</html>");
  const ProgramResult refused = Discover({"--quiet"});
  EXPECT_EQ(refused.status, 5);
  EXPECT_THAT(refused.err, HasSubstr("report.html"));
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_EQ(Discover({"--quiet", "--force"}).status, 0);
  EXPECT_EQ(Discover({"--quiet"}).status, 0);
}

TEST_F(CliDiscover, RefusesWhatItsFlagsDoNotTake) {
  EXPECT_EQ(Discover({"--alpha=0"}).status, 2);
  EXPECT_EQ(Discover({"--bootstraps=98"}).status, 2);
  EXPECT_EQ(Discover({"--noise_position=1e-4"}).status, 2);  // goes with --noise_orientation
  EXPECT_EQ(Discover({"--draws=1000"}).status, 2);
  EXPECT_EQ(Call({"discover", "--out=out"}).status, 2);
  EXPECT_EQ(Call({"discover", "none.yaml", "--out=out"}).status, 3);
}

}  // namespace
}  // namespace hexcal
