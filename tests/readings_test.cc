// SPDX-License-Identifier: BSD-3-Clause
#include "report/readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "config/input_error.h"
#include "report/change.h"
#include "report/result_json.h"
#include "testing/random.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

Dataset Measured() {
  auto rng = testing::SeededByTest();
  Dataset dataset;
  dataset.measurement.emplace();
  dataset.measurement->kind = Measurement::Kind::kMarkers;
  for (int i = 0; i < 4; ++i) {
    dataset.robot_poses.rows.push_back({"p" + std::to_string(i), {}, {}, i + 2});
    for (int b = 0; b < 2; ++b)
      for (int m = 0; m < 3; ++m)
        dataset.measurement->readings.push_back(
            {i, 0, static_cast<BodyId>(b), m, Eigen::Vector3d(testing::Normal(rng, 3))});
  }
  return dataset;
}

TEST(Readings, AreKnownAgainInAnotherOrderAndUnderOtherNames) {
  Dataset dataset = Measured();
  const DatasetReadings before = ReadingsOf(dataset);
  std::reverse(dataset.measurement->readings.begin(), dataset.measurement->readings.end());
  dataset.robot_poses.rows[0].label = "another name";
  const DatasetReadings after = ReadingsOf(dataset);
  std::set<std::uint64_t> all;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].hash, after[i].hash);
    all.insert(before[i].hash);
  }
  EXPECT_EQ(all.size(), before.size());
  EXPECT_EQ(after[0].pose, "another name");
}

TEST(Readings, AreOthersInTheLastDigitOnAnotherBodyAndWithoutAMarker) {
  const Dataset dataset = Measured();
  const std::uint64_t hash = ReadingsOf(dataset)[0].hash;
  Dataset other = dataset;
  double& x = other.measurement->readings[0].p_in_tracker.x();
  x = std::nextafter(x, 10.0);
  EXPECT_NE(ReadingsOf(other)[0].hash, hash);
  EXPECT_EQ(ReadingsOf(other)[1].hash, ReadingsOf(dataset)[1].hash);
  other = dataset;
  other.measurement->readings[0].body = BodyId::kTool;
  EXPECT_NE(ReadingsOf(other)[0].hash, hash);
  other = dataset;
  std::swap(other.measurement->readings[0].p_in_tracker.x(),
            other.measurement->readings[0].p_in_tracker.y());
  EXPECT_NE(ReadingsOf(other)[0].hash, hash);
  other = dataset;
  other.measurement->readings.erase(other.measurement->readings.begin());
  EXPECT_NE(ReadingsOf(other)[0].hash, hash);
}

TEST(Readings, OfMeasuredPosesAreTheirNumbers) {
  Dataset dataset;
  dataset.measurement.emplace();
  for (int i = 0; i < 2; ++i) {
    dataset.robot_poses.rows.push_back({std::to_string(i), {}, {}, i + 2});
    dataset.measurement->poses.push_back({i, {}});
  }
  EXPECT_EQ(ReadingsOf(dataset)[0].hash, ReadingsOf(dataset)[1].hash);
  dataset.measurement->poses[1].world_from_tool.translation.z() = 1e-9;
  EXPECT_NE(ReadingsOf(dataset)[0].hash, ReadingsOf(dataset)[1].hash);
}

TEST(Share, CountsWhatIsInBothAndKnowsWhatIsNotKnown) {
  const SharedReadings some = Share({"c", "a", "b"}, {"x", "b", "a", "y"});
  EXPECT_TRUE(some.is_known);
  EXPECT_EQ(some.poses, 2);
  EXPECT_EQ(some.of, 3);
  EXPECT_EQ(some.earlier_of, 4);
  EXPECT_FALSE(Share({"a"}, {}).is_known);
  EXPECT_EQ(Share({"a"}, {}).poses, 0);
}

Estimate Calibrated() {
  Estimate estimate;
  estimate.converged = true;
  estimate.observability.determined.fill(true);
  estimate.covariance.diagonal().setConstant(1e-10);
  for (int i = 0; i < 4; ++i) {
    estimate.poses.emplace_back();
    estimate.poses.back().label = "p" + std::to_string(i);
  }
  return estimate;
}

// Through the file, there and back.
EarlierResult Earlier(const Estimate& estimate, const DatasetReadings& readings) {
  const testing::TemporaryFolder folder;
  ResultHeader header = {"demo", "nonlinear", "marker", "", readings};
  return ReadEarlierResult(folder.Write("r.json", ResultJson(header, estimate)));
}

TEST(EarlierResult, OfWhichTheCovarianceIsNoneIsRefused) {
  Estimate estimate = Calibrated();
  estimate.covariance(0, 1) = estimate.covariance(1, 0) = 2e-10;  // a correlation of 2
  try {
    Earlier(estimate, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a matrix that is no covariance"), std::string::npos);
  }
}

// By hand: 3e-5 of two variances of 1e-10 is 2.12 of their difference and 3 of one.
TEST(ChangeOf, IsTestedOnlyWhereNoReadingIsInBoth) {
  const Dataset dataset = Measured();
  const DatasetReadings readings = ReadingsOf(dataset);
  Estimate now = Calibrated();
  const EarlierResult same = Earlier(now, readings);
  EXPECT_EQ(same.readings.size(), 4u);
  now.mounts.world_from_base.translation.x() = 3e-5;

  DatasetReadings others = readings;
  for (PoseReadings& pose : others) ++pose.hash;
  const Change independent = ChangeOf(same, now, others, {}, {});
  EXPECT_TRUE(independent.shared.is_known);
  EXPECT_NEAR(independent.sigmas[0], 3.0 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(independent.chi_square, 4.5, 1e-9);
  EXPECT_GT(independent.p_value, 0.9);

  others[2] = readings[2];
  const Change shared = ChangeOf(same, now, others, {}, {});
  EXPECT_EQ(shared.shared.poses, 1);
  EXPECT_TRUE(std::isnan(shared.sigmas[0]));
  EXPECT_TRUE(std::isnan(shared.chi_square) && std::isnan(shared.p_value));
  EXPECT_NEAR(shared.over_own[0], 3.0, 1e-9);
  EXPECT_NE(WordsOf(shared.shared).find("one pose (of 4 used now and 4 used then)"),
            std::string::npos);

  now.poses[2].weight = 0.0;  // not used: not shared
  EXPECT_EQ(ChangeOf(same, now, others, {}, {}).shared.poses, 0);
  EXPECT_FALSE(ChangeOf(Earlier(now, {}), now, readings, {}, {}).shared.is_known);
}

// By hand: along x four variances of 1e-10 add, of base and tool now and then.
TEST(ChangeOf, SaysHowSureAPointsMoveIsWhereItIsTested) {
  const DatasetReadings readings = ReadingsOf(Measured());
  Estimate now = Calibrated();
  const EarlierResult earlier = Earlier(now, readings);
  now.mounts.world_from_base.translation.x() = 3e-5;
  DatasetReadings others = readings;
  for (PoseReadings& pose : others) ++pose.hash;
  const std::vector<NamedPoint> points = {{"tip"}};
  const Change change = ChangeOf(earlier, now, others, points, {});
  EXPECT_NEAR(change.at_points[0], 3e-5, 1e-15);
  EXPECT_NEAR(change.sigma_at_points[0], 2e-5, 1e-12);
  EXPECT_TRUE(std::isnan(ChangeOf(earlier, now, readings, points, {}).sigma_at_points[0]));

  now.covariance *= 1e-20;  // of exact data
  const Change exact = ChangeOf(earlier, now, others, points, {});
  EXPECT_TRUE(exact.is_of_exact);
  EXPECT_TRUE(std::isnan(exact.p_value) && std::isnan(exact.sigmas[0]));
  EXPECT_TRUE(std::isnan(exact.sigma_at_points[0]));
}

}  // namespace
}  // namespace hexcal
