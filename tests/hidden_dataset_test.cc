// SPDX-License-Identifier: BSD-3-Clause
// What is given to discovery in memory is what is written for it to files.
#include <gtest/gtest.h>

#include <filesystem>

#include "hidden/as_dataset.h"
#include "hidden/write_case.h"
#include "testing/bits.h"
#include "testing/temporary_folder.h"

namespace hexcal::hidden {
namespace {

using testing::SameBits;
using testing::TemporaryFolder;

TEST(HiddenDataset, FilesAndMemoryHoldTheSame) {
  for (const char* kind : {"latency", "leg_clearance", "tracker_warmup", "pair"}) {
    CaseOptions options;
    options.kind = kind;
    const Case made = MakeCase(options, 11, 0);
    TemporaryFolder folder;
    std::filesystem::create_directory(folder.Path("heldout"));
    for (const auto& [name, content] : CaseFiles(made, options)) folder.Write(name, content);
    const Dataset read = ReadDataset(folder.Path("dataset.yaml"), true);
    ReadDataset(folder.Path("heldout/dataset.yaml"), false);
    const Dataset given = AsDataset(made);

    EXPECT_EQ(read.name, given.name);
    EXPECT_EQ(read.tracker.is_static, given.tracker.is_static);
    EXPECT_TRUE(SameBits(read.hexapod->base_joints_in_base, given.hexapod->base_joints_in_base));
    EXPECT_TRUE(SameBits(read.hexapod->platform_joints_in_platform,
                         given.hexapod->platform_joints_in_platform));
    EXPECT_EQ(read.hexapod->base_axes_in_base.has_value(),
              given.hexapod->base_axes_in_base.has_value());
    EXPECT_EQ(read.hexapod->home.has_value(), given.hexapod->home.has_value());
    ASSERT_EQ(read.robot_poses.rows.size(), given.robot_poses.rows.size());
    for (std::size_t i = 0; i < given.robot_poses.rows.size(); ++i) {
      const Pose3d &a = read.robot_poses.rows[i].base_from_platform,
                   &b = given.robot_poses.rows[i].base_from_platform;
      EXPECT_EQ(read.robot_poses.rows[i].label, given.robot_poses.rows[i].label);
      EXPECT_LT(Minus(a, b).norm(), 1e-14);
    }
    ASSERT_EQ(read.robot_poses.covariates.size(), given.robot_poses.covariates.size());
    for (std::size_t c = 0; c < given.robot_poses.covariates.size(); ++c) {
      EXPECT_EQ(read.robot_poses.covariates[c].name, given.robot_poses.covariates[c].name);
      EXPECT_EQ(read.robot_poses.covariates[c].values, given.robot_poses.covariates[c].values);
    }
    ASSERT_EQ(read.measurement->readings.size(), given.measurement->readings.size());
    for (std::size_t k = 0; k < given.measurement->readings.size(); ++k) {
      const MarkerReading &a = read.measurement->readings[k], &b = given.measurement->readings[k];
      EXPECT_TRUE(a.pose == b.pose && a.body == b.body && a.marker == b.marker);
      EXPECT_TRUE(SameBits(a.p_in_tracker, b.p_in_tracker));
    }
    for (int body = 0; body < 2; ++body)
      EXPECT_TRUE(SameBits(read.measurement->bodies[body].p_in_body,
                           given.measurement->bodies[body].p_in_body));
    EXPECT_TRUE(SameBits(*read.measurement->marker_sigma, *given.measurement->marker_sigma));
  }
}

}  // namespace
}  // namespace hexcal::hidden
