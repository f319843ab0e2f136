// SPDX-License-Identifier: BSD-3-Clause
#include "report/export/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>

#include "config/strict_yaml.h"
#include "measurement/labels.h"
#include "report/earlier_result.h"

namespace hexcal {
namespace {

const YamlNode& Key(const YamlNode& map, std::string_view key) {
  for (const auto& [name, value] : map.entries)
    if (name.scalar == key) return value;
  throw InputError(
      map.where, "no key '" + std::string(key) + "'", "a result.json of hexcal calibrate");
}

// Results of earlier versions do not say.
std::string ReadingsIn(const YamlNode& pose) {
  for (const auto& [name, value] : pose.entries)
    if (name.scalar == "readings") return ReadText(value);
  return "";
}

// The block of six from first on, where all of it is determined.
CalibratedMount Mount(const EarlierResult& result, const Pose3d& pose, int first) {
  const auto begin = result.determined.begin() + first;
  if (!std::all_of(begin, begin + 6, [](bool determined) { return determined; }))
    return {pose, std::nullopt};
  return {pose, Matrix6d(result.covariance.block<6, 6>(first, first))};
}

// It goes into comments of other formats as it is.
void CheckName(const EarlierResult& result) {
  constexpr std::string_view kAllowed =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
  if (result.dataset.find_first_not_of(kAllowed) == std::string::npos) return;
  throw InputError(FileLocation(result.path),
                   "the dataset " + Quoted(result.dataset),
                   "a name of letters, digits, '.', '_' and '-'");
}

}  // namespace

Calibration ReadCalibration(const std::string& path) {
  const EarlierResult result = ReadEarlierResult(path);
  CheckName(result);
  Calibration calibration;
  calibration.path = path;
  calibration.dataset = result.dataset;
  calibration.base = Mount(result, result.mounts.world_from_base, 0);
  calibration.tool = Mount(result, result.mounts.platform_from_tool, 6);
  const YamlNode root = ParseYamlFile(path);  // JSON is YAML
  for (const YamlNode& node : ReadSequence(Key(root, "poses"), "a list of poses")) {
    const std::vector<double> residual =
        ReadNumbers(Key(node, "residual"), 6, "a residual of six numbers");
    const YamlNode& label = Key(node, "pose");
    CheckLabel(ReadText(label), label.where, "pose label");
    calibration.poses.push_back({label.scalar,
                                 ReadNumber(Key(node, "weight")),
                                 Eigen::Map<const Vector6d>(residual.data()),
                                 ReadingsIn(node)});
  }
  return calibration;
}

void RequireSameReadings(const Calibration& calibration,
                         const DatasetReadings& readings,
                         const std::string& dataset_path) {
  std::map<std::string_view, std::uint64_t> by_label;
  for (const PoseReadings& pose : readings) by_label[pose.pose] = pose.hash;
  for (const CalibratedPose& pose : calibration.poses) {
    const auto found = by_label.find(pose.label);
    if (found == by_label.end() || pose.readings.empty()) continue;
    if (HexOf(found->second) == pose.readings) continue;
    throw InputError(
        FileLocation(calibration.path),
        fmt::format("other readings of the pose {} than in {}", Quoted(pose.label), dataset_path),
        fmt::format("the result of this dataset (it is of '{}')", calibration.dataset));
  }
}

}  // namespace hexcal
