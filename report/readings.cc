// SPDX-License-Identifier: BSD-3-Clause
#include "report/readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace hexcal {
namespace {

constexpr std::uint64_t kNone = 14695981039346656037u;  // FNV-1a's offset basis

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo): quick, and nobody forges their own readings.
std::uint64_t Hash(std::uint64_t hash, double value) {
  std::array<unsigned char, sizeof(double)> bytes;
  std::memcpy(bytes.data(), &value, sizeof(double));
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211u;
  return hash;
}

template <typename Values>
std::uint64_t HashOf(double first, const Values& values) {
  std::uint64_t hash = Hash(kNone, first);
  for (const double value : values) hash = Hash(hash, value);
  return hash;
}

}  // namespace

DatasetReadings ReadingsOf(const Dataset& dataset) {
  DatasetReadings all;
  for (const RobotPose& row : dataset.robot_poses.rows) all.push_back({row.label, 0});
  const Measurement& measurement = *dataset.measurement;
  // Sums: the order of the rows does not matter.
  for (const MarkerReading& r : measurement.readings)
    all[r.pose].hash += HashOf(r.body == BodyId::kBase ? 1.0 : 2.0, r.p_in_tracker);
  for (const MeasuredPose& measured : measurement.poses) {
    const Eigen::Vector3d& p = measured.world_from_tool.translation;
    const Eigen::Vector4d& q = measured.world_from_tool.rotation.coeffs();
    all[measured.pose].hash +=
        HashOf(3.0, std::array<double, 7>{p.x(), p.y(), p.z(), q[0], q[1], q[2], q[3]});
  }
  return all;
}

std::string HexOf(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

SharedReadings Share(std::vector<std::string> now, std::vector<std::string> earlier) {
  SharedReadings shared;
  shared.is_known = !now.empty() && !earlier.empty();
  shared.of = static_cast<long>(now.size());
  shared.earlier_of = static_cast<long>(earlier.size());
  std::sort(now.begin(), now.end());
  std::sort(earlier.begin(), earlier.end());
  std::vector<std::string> both;
  std::set_intersection(
      now.begin(), now.end(), earlier.begin(), earlier.end(), std::back_inserter(both));
  shared.poses = static_cast<long>(both.size());
  return shared;
}

}  // namespace hexcal
