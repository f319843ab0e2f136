// SPDX-License-Identifier: BSD-3-Clause
#include "report/row_counts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

// Bodies of three markers each, and in line with two of the tool's a fourth.
const char* const kDataset = R"(format: hexcal/dataset/1
name: counted
units: {length: mm, angle: rad}
robot_poses: {file: poses.csv}
tracker: {static: STATIC}
measurement:
  kind: markers
  file: markers.csv
  bodies:
    base: {frame: rigid, markers: {b1: [0, 0, 0], b2: [100, 0, 0], b3: [0, 100, 0]}}
    tool: {frame: rigid, markers: {t1: [0, 0, 0], t2: [50, 0, 0], t3: [0, 50, 0], t4: [25, 0, 0]}}
)";

const char* const kBase = "base,b1,0,0,0\nbase,b2,100,0,0\nbase,b3,0,100,0\n";

std::string Rows(const std::string& pose, std::string body) {
  std::string rows;
  while (!body.empty()) {
    const std::size_t end = body.find('\n') + 1;
    rows += pose + "," + body.substr(0, end);
    body.erase(0, end);
  }
  return rows;
}

// p1 to p4 whole but for t4 without a row in p1 and without coordinates in p2 and p3; p5 without
// t3: collinear; p6 with two markers alone and a row without coordinates; p7 without a row.
std::string Markers() {
  const std::string three = "tool,t1,0,0,500\ntool,t2,50,0,500\ntool,t3,0,50,500\n";
  const std::string fourth = "tool,t4,25,0,500\n", unseen = "tool,t4,,,\n";
  return "pose,body,marker,x,y,z\n" + Rows("p1", kBase + three) +
         Rows("p2", kBase + three + unseen) + Rows("p3", kBase + three + unseen) +
         Rows("p4", kBase + three + fourth) +
         Rows("p5", std::string(kBase) + "tool,t1,0,0,500\ntool,t2,50,0,500\n" + fourth) +
         Rows("p6", std::string(kBase) + "tool,t1,0,0,500\ntool,t2,50,0,500\ntool,t3,,,\n");
}

class RowCounts : public ::testing::Test {
 protected:
  Dataset Read(const std::string& is_static) const {
    std::string poses = "pose,x,y,z,rx,ry,rz\n";
    for (int i = 1; i <= 7; ++i)
      poses += "p" + std::to_string(i) + "," + std::to_string(i) + ",0,200,0,0,0\n";
    folder.Write("poses.csv", poses);
    folder.Write("markers.csv", Markers());
    std::string text = kDataset;
    text.replace(text.find("STATIC"), 6, is_static);
    return ReadDataset(folder.Write("dataset.yaml", text), true);
  }

  // p3 was rejected.
  static Estimate Found() {
    Estimate estimate;
    for (const char* pose : {"p1", "p2", "p3", "p4"}) {
      estimate.poses.emplace_back();
      estimate.poses.back().label = pose;
    }
    estimate.poses[2].weight = 0.0;
    return estimate;
  }

  testing::TemporaryFolder folder;
};

const RowCount& Of(const std::vector<RowCount>& counts, const std::string& input) {
  for (const RowCount& count : counts)
    if (count.input == input) return count;
  throw std::runtime_error("no " + input);
}

TEST_F(RowCounts, SayWhatBecameOfEveryPoseAndReading) {
  const auto counts = CountRows(Read("false"), Found());
  ASSERT_EQ(counts.size(), 1u + 3u + 4u);
  const RowCount& poses = counts[0];
  EXPECT_EQ(poses.input, "robot poses");
  EXPECT_EQ(poses.given, 7);
  EXPECT_EQ(poses.used, 3);
  EXPECT_EQ(poses.missing, 1);
  EXPECT_EQ(poses.rejected, 3);
  EXPECT_THAT(poses.reasons,
              UnorderedElementsAre(Pair("no_weight", 1),
                                   Pair("collinear_markers", 1),
                                   Pair("too_few_markers", 1),
                                   Pair("no_reading", 1)));
  const RowCount& base = Of(counts, "base/b1");
  EXPECT_EQ(base.given, 6);
  EXPECT_EQ(base.used, 3);
  EXPECT_EQ(base.missing, 0);
  EXPECT_EQ(base.rejected, 3);
  const RowCount& t3 = Of(counts, "tool/t3");  // in p1 to p4, empty in p6, no row in p5
  EXPECT_EQ(t3.given, 5);
  EXPECT_EQ(t3.used, 3);
  EXPECT_EQ(t3.missing, 2);
  EXPECT_EQ(t3.rejected, 1);
  const RowCount& t4 = Of(counts, "tool/t4");
  EXPECT_EQ(t4.given, 4);
  EXPECT_EQ(t4.used, 1);      // p4
  EXPECT_EQ(t4.missing, 4);   // empty in p2 and p3, no row in p1 and p6
  EXPECT_EQ(t4.rejected, 1);  // p5
  EXPECT_THAT(
      t4.reasons,
      UnorderedElementsAre(Pair("not_seen", 2), Pair("no_row", 2), Pair("collinear_markers", 1)));
}

// Nothing is lost: what is not given had no row.
TEST_F(RowCounts, AddUp) {
  for (const char* is_static : {"false", "true"})
    for (const RowCount& count : CountRows(Read(is_static), Found())) {
      long absent = 0, of_reasons = 0;
      for (const auto& [code, number] : count.reasons) {
        of_reasons += number;
        if (code == "no_row") absent = number;
      }
      EXPECT_EQ(count.given + absent, count.used + count.missing + count.rejected) << count.input;
      EXPECT_EQ(of_reasons, count.missing + count.rejected) << count.input;
    }
}

TEST_F(RowCounts, OfATrackerThatStoodStillAllBaseReadingsAreUsed) {
  const auto counts = CountRows(Read("true"), Found());
  EXPECT_EQ(Of(counts, "base/b2").used, 6);
  EXPECT_THAT(Of(counts, "base/b2").reasons, IsEmpty());
  EXPECT_EQ(Of(counts, "tool/t1").used, 3);
}

TEST(RowCountsOfPoses, CountMeasuredPosesBesideThoseOfTheRobot) {
  Dataset dataset;
  dataset.measurement.emplace();
  for (int i = 0; i < 5; ++i) {
    dataset.robot_poses.rows.push_back({std::to_string(i), {}, {}, i + 2});
    if (i < 4) dataset.measurement->poses.push_back({i, {}});
  }
  Estimate estimate;
  for (int i = 0; i < 4; ++i) {
    estimate.poses.emplace_back();
    estimate.poses.back().label = std::to_string(i);
  }
  estimate.poses[3].weight = 0.0;
  const auto counts = CountRows(dataset, estimate);
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[1].input, "measured poses");
  EXPECT_EQ(counts[1].given, 4);
  EXPECT_EQ(counts[1].used, 3);
  EXPECT_THAT(counts[1].reasons, ElementsAre(Pair("no_weight", 1)));
  EXPECT_EQ(counts[0].missing, 1);
}

}  // namespace
}  // namespace hexcal
