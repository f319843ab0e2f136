// SPDX-License-Identifier: BSD-3-Clause
// The picture of the frames as text. That a browser draws it: browser_audit_test.
#include "report/frame_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

Dataset Measured(Measurement::Kind kind) {
  Dataset dataset;
  dataset.measurement.emplace();
  dataset.measurement->kind = kind;
  return dataset;
}

// Two mounts are estimated, one transform is known; each stands once more in the legend.
TEST(FrameGraph, DrawsWhichTransformsAreEstimatedKnownAndMeasured) {
  Dataset dataset = Measured(Measurement::Kind::kMarkers);
  dataset.measurement->bodies[0].markers = {"b1", "b2", "b3"};
  dataset.measurement->bodies[1].markers = {"t1", "t2", "t3", "t4"};
  const std::string svg = FrameGraphDrawing(FrameGraphOf(dataset, {})).svg;
  EXPECT_EQ(Count(svg, "url(#tip-estimated)"), 2 + 1);
  EXPECT_EQ(Count(svg, "url(#tip-known)"), 1 + 1);
  EXPECT_EQ(Count(svg, "url(#tip-measured)"), 2 + 1);
  EXPECT_THAT(svg,
              AllOf(HasSubstr(">3 markers of<"),
                    HasSubstr(">4 markers of<"),
                    HasSubstr(">as the robot says<"),
                    HasSubstr(">tracker<"),
                    Not(HasSubstr("stood still"))));
  dataset.tracker.is_static = true;
  dataset.robot_poses.are_leg_lengths = true;
  EXPECT_THAT(FrameGraphDrawing(FrameGraphOf(dataset, {})).svg,
              AllOf(HasSubstr("stood still"), HasSubstr(">by leg lengths<")));
}

TEST(FrameGraph, HasNoTrackerOfItsOwnWhereItIsTheWorldOrPosesWereMeasured) {
  Dataset dataset = Measured(Measurement::Kind::kMarkers);
  dataset.measurement->bodies[1].markers = {"t1", "t2", "t3"};
  std::string svg = FrameGraphDrawing(FrameGraphOf(dataset, {})).svg;
  EXPECT_EQ(Count(svg, "url(#tip-measured)"), 1 + 1);
  EXPECT_THAT(svg, AllOf(HasSubstr(">world: the tracker<"), Not(HasSubstr(">M<"))));
  svg = FrameGraphDrawing(FrameGraphOf(Measured(Measurement::Kind::kPoses), {})).svg;
  EXPECT_THAT(svg, AllOf(HasSubstr(">world of the poses<"), HasSubstr(">T_T^W<")));
}

// Names come from a file: escaped, and cut between characters where they are long.
TEST(FrameGraph, NamesPointsAsPlainText) {
  const Dataset dataset = Measured(Measurement::Kind::kPoses);
  const std::string svg =
      FrameGraphDrawing(FrameGraphOf(dataset, {"<b>&", "another", "a third"})).svg;
  EXPECT_THAT(svg, HasSubstr(">point: &lt;b&gt;&amp; and 2 more<"));
  std::string name;
  for (int i = 0; i < 30; ++i) name += "µ";
  EXPECT_THAT(FrameGraphDrawing(FrameGraphOf(dataset, {name})).svg,
              HasSubstr(">point: " + name.substr(0, 48) + "…<"));
}

}  // namespace
}  // namespace hexcal
