// SPDX-License-Identifier: BSD-3-Clause
// The built program and its files: what predict and simulate write, what they refuse to replace,
// settings from a config file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

using ::hexcal::testing::Arguments;

constexpr const char* kDataset = R"(format: hexcal/dataset/1
name: demo
units: {length: mm, angle: deg}
robot_poses:
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [a, 0, 0, 100, 0, 0, 0]
    - [b, 10, 0, 100, 90, 0, 0]
    - [c, 0, 10, 100, 0, 5, 0]
measurement:
  kind: poses
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [a, 0, 0, 0, 0, 0, 0]
    - [b, 0, 0, 0, 0, 0, 0]
    - [c, 0, 0, 0, 0, 0, 0]
  noise: {position: 0.1, orientation: 0.01}
)";

// The base is turned so that its x, y, z are the y, z, x of the world; the tool is moved along y.
constexpr const char* kModel = R"(format: hexcal/model/1
dataset: demo
world_from_base: {xyz: [1, 2, 3], quaternion: [0.5, 0.5, 0.5, 0.5]}
platform_from_tool: {xyz: [0, 0.5, 0], quaternion: [1, 0, 0, 0]}
)";

class CliFiles : public testing::CliTest {
 protected:
  CliFiles() {
    folder.Write("d.yaml", kDataset);
    folder.Write("m.yaml", kModel);
  }

  ProgramResult Predict(const Arguments& more = {}) const {
    return Call({"predict", "d.yaml", "--model=m.yaml", "--out=p.csv"}, more);
  }

  ProgramResult Simulate(const Arguments& more = {}) const {
    return Call({"simulate", "d.yaml", "--model=m.yaml"}, more);
  }
};

// Pose a by hand: (0, 0.5, 0.1) in the base is (0.1, 0, 0.5) in the world, from (1, 2, 3).
TEST_F(CliFiles, PredictWritesWhereTheToolIs) {
  const ProgramResult result = Predict();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "p.csv: 3 poses predicted\n");
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(folder.Read("p.csv"),
              StartsWith("pose,x,y,z,qw,qx,qy,qz\na,1.1,2,3.5,0.5,0.5,0.5,0.5\nb,"));
}

TEST_F(CliFiles, PredictReplacesItsOwnTableByTheSameBytes) {
  EXPECT_EQ(Predict().status, 0);
  const std::string first = folder.Read("p.csv");
  EXPECT_EQ(Predict({"--quiet"}).status, 0);
  EXPECT_EQ(folder.Read("p.csv"), first);
}

TEST_F(CliFiles, QuietPrintsNothing) { EXPECT_THAT(Predict({"--quiet"}).out, IsEmpty()); }

TEST_F(CliFiles, AForeignFileIsReplacedOnlyByForce) {
  folder.Write("p.csv", "precious\n");
  const ProgramResult refused = Predict();
  EXPECT_EQ(refused.status, 5);
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(refused.err, HasSubstr("p.csv: this file is in the way"));
  EXPECT_EQ(folder.Read("p.csv"), "precious\n");
  EXPECT_EQ(Predict({"--force"}).status, 0);
  EXPECT_THAT(folder.Read("p.csv"), StartsWith("pose,"));
}

TEST_F(CliFiles, AnInputIsNeverReplaced) {
  for (const char* input : {"d.yaml", "m.yaml"}) {
    const ProgramResult result =
        Call({"predict", "d.yaml", "--model=m.yaml", "--force", std::string("--out=./") + input});
    EXPECT_EQ(result.status, 5);
    EXPECT_THAT(result.err, HasSubstr("would replace an input of this run"));
  }
  EXPECT_EQ(folder.Read("d.yaml"), kDataset);
  EXPECT_EQ(folder.Read("m.yaml"), kModel);
}

TEST_F(CliFiles, AFolderIsNoFile) {
  EXPECT_EQ(Call({"predict", "d.yaml", "--model=m.yaml", "--out=new/"}).status, 2);
  EXPECT_EQ(Call({"predict", "d.yaml", "--model=m.yaml", "--out=.."}).status, 5);
}

TEST_F(CliFiles, ARefusedInputLeavesNoFile) {
  folder.Write("d.yaml", "format: hexcal/dataset/1\nnam: demo\n");
  const ProgramResult result = Predict();
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, StartsWith("hexcal: d.yaml:2:1: "));
  EXPECT_THAT(folder.Names(), UnorderedElementsAre("d.yaml", "m.yaml"));
}

TEST_F(CliFiles, SimulateWithoutNoiseMeasuresThePrediction) {
  const ProgramResult result = Simulate({"--noise=0", "--out=out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.out, "out/demo/dataset.yaml: 3 poses simulated\n");
  EXPECT_THAT(folder.Read("out/demo/measured.csv"),
              StartsWith("pose,x,y,z,qw,qx,qy,qz\na,1.1,2,3.5,0.5,0.5,0.5,0.5\nb,"));
}

TEST_F(CliFiles, ASimulatedDatasetIsADataset) {
  EXPECT_EQ(Simulate({"--out=out"}).status, 0);
  EXPECT_EQ(Predict().status, 0);
  EXPECT_EQ(Call({"predict", "out/demo/dataset.yaml", "--model=m.yaml", "--out=q.csv"}).status, 0);
  EXPECT_EQ(folder.Read("q.csv"), folder.Read("p.csv"));
}

TEST_F(CliFiles, TheSeedDrawsTheNoise) {
  EXPECT_EQ(Simulate({"--out=one", "--seed=7"}).status, 0);
  EXPECT_EQ(Simulate({"--out=two", "--seed", "7"}).status, 0);
  EXPECT_EQ(Simulate({"--out=three", "--seed=8"}).status, 0);
  const std::string one = folder.Read("one/demo/measured.csv");
  EXPECT_THAT(one, StartsWith("pose,"));
  EXPECT_EQ(folder.Read("two/demo/measured.csv"), one);
  EXPECT_NE(folder.Read("three/demo/measured.csv"), one);
  EXPECT_EQ(folder.Read("one/demo/dataset.yaml"), folder.Read("two/demo/dataset.yaml"));
}

TEST_F(CliFiles, SimulateReplacesItsOwnDatasetAndNoOther) {
  EXPECT_EQ(Simulate({"--out=out"}).status, 0);
  EXPECT_EQ(Simulate({"--out=out", "--seed=2"}).status, 0);
  folder.Write("out/demo/dataset.yaml", kDataset);
  EXPECT_EQ(Simulate({"--out=out"}).status, 5);
  EXPECT_EQ(folder.Read("out/demo/dataset.yaml"), kDataset);
  EXPECT_EQ(Simulate({"--out=out", "--force"}).status, 0);
}

TEST_F(CliFiles, SimulateNeverReplacesTheDatasetThatItReads) {
  EXPECT_EQ(Simulate({"--out=out"}).status, 0);
  const std::string before = folder.Read("out/demo/dataset.yaml");
  const Arguments again = {
      "simulate", "out/demo/dataset.yaml", "--model=m.yaml", "--out=out", "--force"};
  EXPECT_EQ(Call(again).status, 5);
  EXPECT_EQ(folder.Read("out/demo/dataset.yaml"), before);
}

TEST_F(CliFiles, AFileWhereTheFolderShouldBeIsAnErrorOfWriting) {
  folder.Write("out", "a file");
  const ProgramResult result = Simulate({"--out=out"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("out is a file"));
}

TEST_F(CliFiles, ConfigHoldsTheSettingsAndTheCommandLineWins) {
  folder.Write("c.yaml", "seed: 7\nout: from_config\nmodel: m.yaml\nquiet: true\n");
  EXPECT_EQ(Call({"simulate", "d.yaml", "--config=c.yaml"}).status, 0);
  EXPECT_EQ(Simulate({"--out=seven", "--seed=7"}).status, 0);
  EXPECT_EQ(folder.Read("from_config/demo/dataset.yaml"), folder.Read("seven/demo/dataset.yaml"));
  const ProgramResult loud =
      Call({"simulate", "d.yaml", "--config=c.yaml", "--out=nine", "--seed=9", "--noquiet"});
  EXPECT_THAT(loud.out, HasSubstr("3 poses simulated"));
  EXPECT_THAT(folder.Read("nine/demo/dataset.yaml"), HasSubstr("--seed=9 "));
}

TEST_F(CliFiles, ABadConfigIsARefusedInputWithItsPlace) {
  const auto refusal = [&](const char* text) {
    folder.Write("c.yaml", text);
    const ProgramResult result = Simulate({"--out=out", "--config=c.yaml", "--seed=1"});
    EXPECT_EQ(result.status, 3) << text;
    EXPECT_THAT(result.out, IsEmpty());
    return result.err;
  };
  EXPECT_THAT(refusal("noise: 1\nsead: 3\n"),
              HasSubstr("c.yaml:2:1: found the unknown key 'sead'"));
  EXPECT_THAT(refusal("sead: 3\n"), HasSubstr("did you mean 'seed'?"));
  EXPECT_THAT(refusal("solver: linearized\n"), HasSubstr("unknown key 'solver'"));
  EXPECT_THAT(refusal("config: c.yaml\n"), HasSubstr("unknown key 'config'"));
  EXPECT_THAT(refusal("noise: -1\n"),
              HasSubstr("c.yaml:1:8: found '-1' for noise, expected a number from 0"));
  EXPECT_THAT(refusal("seed: one\n"), HasSubstr("c.yaml:1:7: found 'one' for seed"));
  EXPECT_THAT(refusal("seed: \"1\"\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(refusal("seed: [1]\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(refusal("quiet: yes\n"), HasSubstr("expected true or false"));
  EXPECT_THAT(refusal("seed: 1\nseed: 2\n"), HasSubstr("c.yaml:2:1: "));
  EXPECT_THAT(folder.Names(), UnorderedElementsAre("c.yaml", "d.yaml", "m.yaml"));
}

}  // namespace
}  // namespace hexcal
