// SPDX-License-Identifier: BSD-3-Clause
#include "model/data_fault.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "geometry/rotation_angles.h"
#include "model/hexapod.h"

namespace hexcal {
namespace {

const std::vector<FaultKind>& FaultKinds() {
  static const std::vector<FaultKind> kinds = {
      {"wrong_rotation_order", "", 0, "order", {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}},
      {"transposed_rotation", "", 0, "", {}},
      {"wrong_quaternion_order", "", 0, "", {}},
      {"swapped_legs", "permutation", kNumLegs, "", {}},
      {"swapped_markers", "", 0, "", {}},
      {"shifted_rows", "rows", 1, "", {}},
      {"wrong_unit", "factor", 1, "of", {"lengths", "angles"}}};
  return kinds;
}

const std::vector<double>& NumbersOf(const Effect& fault) {
  const FaultKind& kind = *FindFaultKind(fault.name);
  const auto found = fault.reference.find(std::string(kind.number));
  CHECK(found != fault.reference.end() && static_cast<int>(found->second.size()) == kind.size)
      << fault.name << " without its " << kind.number;
  return found->second;
}

const std::string& WordOf(const Effect& fault) {
  const FaultKind& kind = *FindFaultKind(fault.name);
  const auto found = fault.found.find(std::string(kind.word));
  CHECK(found != fault.found.end()) << fault.name << " without its " << kind.word;
  return found->second;
}

Eigen::Quaterniond InOrder(const Eigen::Vector3d& angles, const std::string& order) {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  for (const char axis : order) {
    const int k = axis - 'x';
    rotation = rotation * Exp(Eigen::Vector3d(angles[k] * Eigen::Vector3d::Unit(k)));
  }
  return rotation.normalized();
}

Eigen::Vector3d AnglesOf(const Pose3d& pose) {
  return AnglesFromRotation(pose.rotation.toRotationMatrix());
}

// Of one recorded pose.
Pose3d MendedPose(const Effect& fault, Pose3d pose) {
  Eigen::Quaterniond& q = pose.rotation;
  if (fault.name == "wrong_rotation_order") {
    q = InOrder(AnglesOf(pose), WordOf(fault));
  } else if (fault.name == "transposed_rotation") {
    q = q.conjugate();
  } else if (fault.name == "wrong_quaternion_order") {
    // What was read as w x y z stands in the table as x y z w.
    q = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  } else if (fault.name == "wrong_unit") {
    const double factor = NumbersOf(fault)[0];
    if (WordOf(fault) == "lengths")
      pose.translation *= factor;
    else
      q = InOrder(factor * AnglesOf(pose), "xyz");
  }
  return pose;
}

std::array<double, kNumLegs> Permuted(const Effect& fault,
                                      const std::array<double, kNumLegs>& lengths) {
  const std::vector<double>& permutation = NumbersOf(fault);
  std::array<double, kNumLegs> permuted = {};
  for (int i = 0; i < kNumLegs; ++i) permuted[static_cast<int>(permutation[i]) - 1] = lengths[i];
  return permuted;
}

// The pose whose legs are those of pose, each in its own place.
Pose3d WithLegsInPlace(const Effect& fault,
                       const RobotPoses& robot_poses,
                       const RobotPose& row,
                       const HexapodGeometry* hexapod) {
  CHECK(hexapod != nullptr) << "swapped legs without a hexapod";
  const LegLengths swapped = InverseKinematics(*hexapod, row.base_from_platform);
  std::array<double, kNumLegs> read = {};
  std::copy(swapped.begin(), swapped.end(), read.begin());
  const std::array<double, kNumLegs> placed = Permuted(fault, read);
  const LegLengths lengths = Eigen::Map<const LegLengths>(placed.data());
  const ForwardKinematicsResult result =
      ForwardKinematics(*hexapod, lengths, row.base_from_platform);
  if (result.converged) return result.base_from_platform;
  Location where = robot_poses.where;
  where.line = row.line;
  where.column = 0;
  throw InputError(where,
                   fmt::format("pose '{}', which its legs in the places that swapped_legs gives "
                               "them do not reach ({})",
                               row.label,
                               result.message),
                   "a pose for these legs");
}

void ShiftRows(int shift, RobotPoses* robot_poses) {
  const std::vector<RobotPose> recorded = robot_poses->rows;
  const int rows = static_cast<int>(recorded.size());
  for (int i = 0; i < rows; ++i) {
    const RobotPose& from = recorded[std::clamp(i + shift, 0, rows - 1)];
    robot_poses->rows[i].base_from_platform = from.base_from_platform;
    robot_poses->rows[i].leg_lengths = from.leg_lengths;
  }
}

void MendRow(const Effect& fault, const HexapodGeometry* hexapod, RobotPoses* robot_poses, int i) {
  RobotPose& row = robot_poses->rows[i];
  if (robot_poses->are_leg_lengths) {
    if (fault.name == "swapped_legs") row.leg_lengths = Permuted(fault, row.leg_lengths);
    if (fault.name == "wrong_unit" && WordOf(fault) == "lengths")
      for (double& length : row.leg_lengths) length *= NumbersOf(fault)[0];
  } else if (fault.name == "swapped_legs") {
    row.base_from_platform = WithLegsInPlace(fault, *robot_poses, row, hexapod);
  } else {
    row.base_from_platform = MendedPose(fault, row.base_from_platform);
  }
}

}  // namespace

const FaultKind* FindFaultKind(std::string_view name) {
  for (const FaultKind& kind : FaultKinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

RobotPoses MendedRobotPoses(const RobotPoses& robot_poses,
                            const std::vector<Effect>& effects,
                            const HexapodGeometry* hexapod) {
  RobotPoses mended = robot_poses;
  for (const Effect& effect : effects) {
    if (FindFaultKind(effect.name) == nullptr) continue;
    if (effect.name == "shifted_rows")
      ShiftRows(static_cast<int>(NumbersOf(effect)[0]), &mended);
    else
      for (std::size_t i = 0; i < mended.rows.size(); ++i)
        MendRow(effect, hexapod, &mended, static_cast<int>(i));
  }
  return mended;
}

Measurement MendedMeasurement(const Measurement& measurement, const std::vector<Effect>& effects) {
  Measurement mended = measurement;
  if (measurement.kind != Measurement::Kind::kMarkers) return mended;
  const int in_base = static_cast<int>(measurement.bodies[0].markers.size());
  const int all = in_base + static_cast<int>(measurement.bodies[1].markers.size());
  for (const Effect& effect : effects) {
    if (effect.name != "swapped_markers") continue;
    CHECK_EQ(effect.index.size(), 2u) << "swapped_markers: two markers";
    if (const int most = std::max(effect.index[0], effect.index[1]); most > all)
      throw InputError(measurement.where,
                       fmt::format("{} markers", all),
                       fmt::format("marker {}, which swapped_markers names", most));
    for (MarkerReading& reading : mended.readings) {
      const int number = 1 + reading.marker + (reading.body == BodyId::kBase ? 0 : in_base);
      if (number != effect.index[0] && number != effect.index[1]) continue;
      const int right = effect.index[0] + effect.index[1] - number - 1;
      reading.body = right < in_base ? BodyId::kBase : BodyId::kTool;
      reading.marker = right < in_base ? right : right - in_base;
    }
  }
  return mended;
}

std::vector<int> MarkersAsRead(const std::vector<Effect>& effects, int markers) {
  std::vector<int> read(markers);
  std::iota(read.begin(), read.end(), 0);
  for (const Effect& effect : effects) {
    if (effect.name != "swapped_markers") continue;
    CHECK_EQ(effect.index.size(), 2u) << "swapped_markers: two markers";
    std::swap(read.at(effect.index[0] - 1), read.at(effect.index[1] - 1));
  }
  return read;
}

}  // namespace hexcal
