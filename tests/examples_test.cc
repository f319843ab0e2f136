// SPDX-License-Identifier: BSD-3-Clause
// examples/neurobot and examples/neurobot-test: made again from their plans by the built program,
// and of the size that the paper's Table V has.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "geometry/align_points.h"
#include "model/hexapod.h"
#include "model/machine.h"
#include "model/predict.h"
#include "testing/matchers.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using nlohmann::json;

const std::string kExamples = HEXCAL_EXAMPLES "/";
const std::string kTruth = kExamples + "neurobot/truth.yaml";

std::string Bundled(const std::string& name) {
  std::ostringstream content;
  content << std::ifstream(kExamples + name, std::ios::binary).rdbuf();
  return content.str();
}

// The dataset to calibrate with and the one to test with.
class NeurobotDataset : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(, NeurobotDataset, ::testing::Values("neurobot", "neurobot-test"));

TEST_P(NeurobotDataset, SimulateMakesTheDatasetAgain) {
  const TemporaryFolder folder;
  const std::string name = GetParam();
  const ProgramResult result = RunHexcal({{"simulate",
                                           kExamples + name + "/plan.yaml",
                                           "--model=" + kTruth,
                                           "--seed=1",
                                           "--out=" + folder.Path("")}});
  ASSERT_EQ(result.status, 0) << result.err;
  for (const std::string file : {"/dataset.yaml", "/poses.csv", "/markers.csv"})
    EXPECT_EQ(folder.Read(name + file), Bundled(name + file)) << file;
}

// Reachable: every leg of every pose is within the limits that the plan states.
TEST_P(NeurobotDataset, TheLegsReachEveryPose) {
  const Dataset dataset = ReadDataset(kExamples + GetParam() + "/dataset.yaml", true);
  ASSERT_EQ(dataset.robot_poses.rows.size(), 60u);
  const Eigen::Vector2d limits = dataset.hexapod->leg_limits.value();
  for (const Pose3d& base_from_platform : ReportedPoses(dataset)) {
    const LegLengths lengths = InverseKinematics(*dataset.hexapod, base_from_platform);
    EXPECT_GE(lengths.minCoeff(), limits[0]);
    EXPECT_LE(lengths.maxCoeff(), limits[1]);
  }
}

TEST(Neurobot, TheTrueToolPosesAreThosePredictedFromTheTruth) {
  const TemporaryFolder folder;
  const ProgramResult result = RunHexcal({{"predict",
                                           kExamples + "neurobot-test/dataset.yaml",
                                           "--model=" + kTruth,
                                           "--out=" + folder.Path("true_poses.csv")}});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(folder.Read("true_poses.csv"), Bundled("neurobot-test/true_poses.csv"));
}

// Equal angles to the middle of the pair on one circle: the paper's pairs B1-B6, B2-B3, B4-B5.
TEST(Neurobot, TheBaseJointsStandInThePairsOfThePaper) {
  const Dataset dataset = ReadDataset(kExamples + "neurobot/dataset.yaml", true);
  const Matrix36d& joints = dataset.hexapod->base_joints_in_base;
  const double pair = (joints.col(0) - joints.col(5)).norm();
  for (const auto& [a, b] : {std::pair(0, 5), std::pair(1, 2), std::pair(3, 4)})
    EXPECT_NEAR((joints.col(a) - joints.col(b)).norm(), pair, 1e-6);
  for (int i = 0; i < kNumLegs; ++i) EXPECT_NEAR(joints.col(i).norm(), 0.15, 1e-6);
  EXPECT_GT((joints.col(0) - joints.col(1)).norm(), 2 * pair);
}

TEST(Neurobot, TheTruthIsTableVMadeOrthonormal) {
  Eigen::Matrix3d base, tool;
  base << 0.99996, -0.00529, 0.00609, 0.00530, 0.99998, -0.00137, -0.00609, 0.00140, 0.99998;
  tool << 0.99964, -0.02628, -0.00447, 0.02626, 0.99964, -0.00352, 0.00456, 0.00341, 0.99998;
  const Machine truth = ReadMachine(kTruth);
  EXPECT_TRUE(testing::PoseNear(truth.world_from_base,
                                MakePose(NearestRotation(base), {-0.00122, -0.00115, -0.00191}),
                                1e-15,
                                1e-14));
  EXPECT_TRUE(testing::PoseNear(truth.platform_from_tool,
                                MakePose(NearestRotation(tool), {-0.00092, -0.00067, 0.03049}),
                                1e-15,
                                1e-14));
}

// Table V: 2.61e-2 m and 3.20e-2 rad before, 7.08e-5 m and 5.83e-4 rad after.
TEST(Neurobot, TheErrorsBeforeAndAfterAreOfTheSizeOfTableV) {
  const TemporaryFolder folder;
  const ProgramResult result = RunHexcal({{"calibrate",
                                           kExamples + "neurobot/dataset.yaml",
                                           "--solver=linearized",
                                           "--out=" + folder.Path("")}});
  ASSERT_EQ(result.status, 0) << result.err;
  const json calibrated = json::parse(folder.Read("neurobot/result.json"));
  EXPECT_NEAR(calibrated["iterations"][0]["rmspe"], 2.61e-2, 1e-3);
  EXPECT_NEAR(calibrated["iterations"][0]["rmsoe"], 3.20e-2, 1e-4);
  EXPECT_NEAR(calibrated["rmspe"], 7.08e-5, 2e-6);
  EXPECT_NEAR(calibrated["rmsoe"], 5.83e-4, 1e-5);
}

}  // namespace
}  // namespace hexcal
