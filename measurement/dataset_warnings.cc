// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/dataset_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hexcal {
namespace {

// m and mm are a factor of 1000 apart; robots and trackers see the same travel within some ten.
constexpr double kOddRatio = 50;
// How large a plate is beside its travel differs more from machine to machine.
constexpr double kOddJointRatio = 200;
// A factor beyond this is no unit: a robot that only turned has no travel at all.
constexpr double kLargestRatio = 20000;

// No hexapod is as large, nor as small, m: a thousand times those of a hand's breadth to some
// metres.
constexpr double kHugeRobot = 50.0, kTinyRobot = 0.002;

// Root mean square distance from the mean, of vectors of any size.
class Spread {
 public:
  void Add(const Eigen::VectorXd& v) {
    if (count_ == 0) sum_ = first_ = Eigen::VectorXd::Zero(v.size());
    if (count_++ == 0) first_ = v;  // sums from there, so that little is lost to rounding
    sum_ += v - first_;
    sum_of_squares_ += (v - first_).squaredNorm();
  }
  int count() const { return count_; }
  double Value() const {
    if (count_ == 0) return 0;
    return std::sqrt(std::max(0.0, (sum_of_squares_ - sum_.squaredNorm() / count_) / count_));
  }

 private:
  int count_ = 0;
  Eigen::VectorXd first_, sum_;
  double sum_of_squares_ = 0;
};

// The larger over the smaller, if that looks like another unit.
std::optional<double> OddRatio(double a, double b, double smallest) {
  const double ratio = std::max(a, b) / std::min(a, b);
  if (ratio >= smallest && ratio <= kLargestRatio) return ratio;
  return std::nullopt;
}

Eigen::VectorXd Recorded(const RobotPoses& robot_poses, int row) {
  const RobotPose& pose = robot_poses.rows[row];
  if (!robot_poses.are_leg_lengths) return pose.base_from_platform.translation;
  return Eigen::Map<const Eigen::VectorXd>(pose.leg_lengths.data(), kNumLegs);
}

// Calls use(first, past the last) for every run of readings of one pose and frame.
template <typename Use>
void ForEachFrame(const std::vector<MarkerReading>& readings, const Use& use) {
  for (std::size_t begin = 0, end = 0; begin < readings.size(); begin = end) {
    while (end < readings.size() && readings[end].pose == readings[begin].pose &&
           readings[end].frame == readings[begin].frame)
      ++end;
    use(begin, end);
  }
}

// Travel of the robot as reported and as seen, over the same poses. Of markers, the distance
// between the bodies' centres: the tracker may have been moved.
void CompareTravel(const Dataset& dataset, std::vector<std::string>& warnings) {
  const Measurement& measurement = *dataset.measurement;
  Spread reported, seen;
  for (const MeasuredPose& pose : measurement.poses) {
    reported.Add(Recorded(dataset.robot_poses, pose.pose));
    seen.Add(pose.world_from_tool.translation);
  }
  ForEachFrame(measurement.readings, [&](std::size_t begin, std::size_t end) {
    std::array<Eigen::Vector3d, 2> sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    std::array<std::size_t, 2> count = {0, 0};
    for (std::size_t i = begin; i < end; ++i) {
      const int body = static_cast<int>(measurement.readings[i].body);
      sum[body] += measurement.readings[i].p_in_tracker;
      ++count[body];
    }
    for (int body = 0; body < 2; ++body)  // a centre moves when a marker is missing
      if (count[body] != measurement.bodies[body].markers.size()) return;
    reported.Add(Recorded(dataset.robot_poses, measurement.readings[begin].pose));
    const double distance = (sum[1] / count[1] - sum[0] / count[0]).norm();
    seen.Add(Eigen::VectorXd::Constant(1, distance));
  });
  if (reported.count() < 3) return;
  if (const auto ratio = OddRatio(reported.Value(), seen.Value(), kOddRatio))
    warnings.push_back(
        fmt::format("{}: the travel in robot_poses and that in the measurement differ by a factor "
                    "of {:.0f}: is one of them in the other unit (m, mm)?",
                    measurement.where.ToString(),
                    *ratio));
}

// Distances between a rigid body's markers, as seen and as known.
void CompareBodies(const Dataset& dataset, std::vector<std::string>& warnings) {
  const Measurement& measurement = *dataset.measurement;
  std::array<double, 2> seen = {0, 0}, known = {0, 0};
  for (std::size_t i = 1; i < measurement.readings.size(); ++i) {
    const MarkerReading &a = measurement.readings[i - 1], &b = measurement.readings[i];
    const int body = static_cast<int>(b.body);
    if (a.pose != b.pose || a.frame != b.frame || a.body != b.body) continue;
    if (measurement.bodies[body].is_centroid) continue;
    const Eigen::Matrix3Xd& p_in_body = measurement.bodies[body].p_in_body;
    seen[body] += (a.p_in_tracker - b.p_in_tracker).norm();
    known[body] += (p_in_body.col(a.marker) - p_in_body.col(b.marker)).norm();
  }
  for (int body = 0; body < 2; ++body)
    if (const auto ratio = OddRatio(seen[body], known[body], kOddRatio))
      warnings.push_back(
          fmt::format("{}: the markers of the {} body are {:.0f} times as far apart {} as {}: is "
                      "one of them in the other unit (m, mm)?",
                      measurement.where.ToString(),
                      body == 0 ? "base" : "tool",
                      *ratio,
                      seen[body] > known[body] ? "in the table" : "in bodies:",
                      seen[body] > known[body] ? "in bodies:" : "in the table"));
}

double Radius(const Matrix36d& joints) {
  return (joints.colwise() - joints.rowwise().mean()).colwise().norm().maxCoeff();
}

double LargestOf(const RobotPoses& robot_poses) {
  double largest = 0;
  for (const RobotPose& pose : robot_poses.rows)
    largest = std::max(largest,
                       robot_poses.are_leg_lengths
                           ? *std::max_element(pose.leg_lengths.begin(), pose.leg_lengths.end())
                           : pose.base_from_platform.translation.norm());
  return largest;
}

void CompareJoints(const Dataset& dataset, std::vector<std::string>& warnings) {
  if (const auto ratio = OddRatio(Radius(dataset.hexapod->base_joints_in_base),
                                  LargestOf(dataset.robot_poses),
                                  kOddJointRatio))
    warnings.push_back(
        fmt::format("{}: the joints of the hexapod and the lengths in robot_poses differ by a "
                    "factor of {:.0f}: is one of them in the other unit (m, mm)?",
                    dataset.path,
                    *ratio));
}

// Where all lengths agree, all may be in the other unit. Small poses say nothing without joints.
void CheckSize(const Dataset& dataset, std::vector<std::string>& warnings) {
  const bool has_joints = dataset.hexapod.has_value();
  const double size =
      has_joints ? Radius(dataset.hexapod->base_joints_in_base) : LargestOf(dataset.robot_poses);
  if (size < kHugeRobot && (!has_joints || size > kTinyRobot)) return;
  warnings.push_back(fmt::format(
      "{}: {} {:.3g} m {}: are all lengths in the other unit than `units:` says (m, mm)?",
      dataset.path,
      has_joints ? "the joints of the hexapod are" : "robot_poses are",
      size,
      has_joints ? "from their middle" : "away from frame B"));
}

void FindEqualJoints(const Matrix36d& joints,
                     std::string_view plate,
                     const std::string& path,
                     std::vector<std::string>& warnings) {
  for (int i = 0; i < kNumLegs; ++i)
    for (int j = 0; j < i; ++j)
      if (joints.col(i) == joints.col(j))
        warnings.push_back(
            fmt::format("{}: {} {} and {} are the same point", path, plate, j + 1, i + 1));
}

}  // namespace

std::vector<std::string> FindOddities(const Dataset& dataset) {
  std::vector<std::string> warnings;
  if (dataset.measurement) {
    CompareTravel(dataset, warnings);
    CompareBodies(dataset, warnings);
  }
  if (dataset.hexapod) {
    const HexapodGeometry& hexapod = *dataset.hexapod;
    CompareJoints(dataset, warnings);
    FindEqualJoints(hexapod.base_joints_in_base, "base_joints", dataset.path, warnings);
    FindEqualJoints(hexapod.platform_joints_in_platform, "platform_joints", dataset.path, warnings);
  }
  if (warnings.empty()) CheckSize(dataset, warnings);
  return warnings;
}

}  // namespace hexcal
