// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/shape_misfit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "geometry/pose.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Readings with noise of four markers, of which the first three make nearly an isosceles triangle.
class ShapeMisfit : public ::testing::Test {
 protected:
  ShapeMisfit() {
    tracker.path = "tracker";
    side.name = "probe";
    shape << -0.070, 0.069, 0, 0.03, -0.040, -0.041, 0.08, 0.01, 0, 0.005, -0.004, 0.06;
    Take(4);
  }

  void Take(int count) {
    std::mt19937_64 random = testing::SeededByTest();
    std::normal_distribution<double> noise(0.0, 5e-5);
    shape.conservativeResize(3, count);
    tracker.markers.clear();
    body.poses.clear();
    side.body = &body;
    side.markers.clear();
    tracker.rows = 30;
    for (int m = 0; m < count; ++m) {
      tracker.markers.push_back({std::string(1, static_cast<char>('A' + m)), {}});
      side.markers.push_back(m);
    }
    for (std::size_t row = 0; row < tracker.rows; ++row) {
      const Pose3d pose{testing::UniformVector(random, 1.0),
                        Exp(testing::UniformVector(random, 1))};
      body.poses.emplace_back(pose);
      for (int m = 0; m < count; ++m) {
        Eigen::Vector3d seen = pose * Eigen::Vector3d(shape.col(m));
        for (double& x : seen) x += noise(random);
        tracker.markers[static_cast<std::size_t>(m)].points.emplace_back(seen);
      }
    }
  }
  std::string Odd(const Eigen::Matrix3Xd& stated,
                  const std::string& path = "probe.rig",
                  bool inverse = false) const {
    return OddShape({tracker}, {&side}, stated, {path, inverse});
  }

  Eigen::Matrix3Xd shape{3, 4};
  Recording tracker;
  RecordedBody body;
  TrackedSide side;
};

TEST_F(ShapeMisfit, HasNoWordForWhatFits) {
  EXPECT_THAT(Odd(shape), IsEmpty());
  EXPECT_THAT(Odd(shape, ""), IsEmpty());
  tracker.markers[2].points.assign(tracker.rows, std::nullopt);  // nothing to lay it on
  EXPECT_THAT(Odd(3.0 * shape), IsEmpty());
}

// No distance is more than 1 mm off.
TEST_F(ShapeMisfit, FindsTwoMarkersInterchanged) {
  Take(3);
  Eigen::Matrix3Xd stated = shape;
  stated.col(0).swap(stated.col(1));
  EXPECT_THAT(Odd(stated), HasSubstr("probe.rig has them, but 0.0"));
  EXPECT_THAT(Odd(stated), HasSubstr("mm in the order B,A,C"));
}

// The order is what --tool is to be given: marker k of it is the shape's k-th.
TEST_F(ShapeMisfit, NamesTheOrderOfTheShape) {
  Eigen::Matrix3Xd stated(3, 4);
  stated << shape.col(2), shape.col(0), shape.col(3), shape.col(1);
  EXPECT_THAT(Odd(stated), HasSubstr("mm in the order C,A,D,B"));
}

// Distances cannot tell.
TEST_F(ShapeMisfit, FindsLeftHandedAxes) {
  Eigen::Matrix3Xd stated = shape;
  stated.row(1) *= -1.0;
  EXPECT_THAT(Odd(stated), HasSubstr("as its mirror image (left-handed axes?)"));
}

TEST_F(ShapeMisfit, SaysThatAShapeDoesNotFit) {
  Eigen::Matrix3Xd stated = shape;
  stated.col(1) += Eigen::Vector3d(0.01, 0.02, 0);
  EXPECT_THAT(Odd(stated), HasSubstr("probe.rig has them: is it the shape of another body?"));
}

TEST_F(ShapeMisfit, HoldsAMeanAgainstItsPoses) {
  EXPECT_THAT(Odd(shape, ""), IsEmpty());
  EXPECT_THAT(Odd(shape, "", true), HasSubstr("are the poses inverted (--measured_inverse)"));
  Eigen::Matrix3Xd turned = shape;
  turned.row(0) *= -1.0;
  turned.row(1) *= -1.0;  // which a motion a row would hide
  EXPECT_THAT(Odd(turned, ""), HasSubstr("from where its poses have them"));
}

}  // namespace
}  // namespace hexcal
