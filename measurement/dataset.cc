// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/dataset.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/strict_yaml.h"
#include "measurement/checked_values.h"
#include "measurement/covariates.h"
#include "measurement/dataset_header.h"
#include "measurement/dataset_warnings.h"
#include "measurement/measurement_reader.h"
#include "measurement/robot_poses_reader.h"
#include "measurement/units_reader.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/dataset/1";
constexpr double kAbsoluteZero = -273.15;  // degC

Eigen::Vector3d ReadGravity(const YamlNode& node) {
  const std::vector<double> g = ReadNumbers(node, 3, "gravity [x, y, z]");
  return CheckedDirection({g[0], g[1], g[2]}, node.where, "gravity");
}

double ReadTemperature(const YamlNode& node) {
  const double temperature = ReadNumber(node, "a temperature in degC");
  if (temperature >= kAbsoluteZero) return temperature;
  throw InputError(node.where,
                   fmt::format("{} for reference_temperature", temperature),
                   fmt::format("a temperature in degC, {} or above", kAbsoluteZero));
}

Tracker ReadTracker(const YamlNode& node, const Units& units) {
  constexpr long kMostFrames = 1'000'000;
  const MapReader map(node, "tracker", {"static", "pose", "frames"});
  Tracker tracker;
  if (const YamlNode* is_static = map.Optional("static")) tracker.is_static = ReadBool(*is_static);
  if (const YamlNode* pose = map.Optional("pose"))
    tracker.tracker_from_world = ReadPose(*pose, units, "the pose of the tracker");
  if (const YamlNode* frames = map.Optional("frames")) {
    const long count = ReadInteger(*frames, "a number of readings a pose");
    if (count < 1 || count > kMostFrames)
      throw InputError(frames->where,
                       fmt::format("{} frames", count),
                       fmt::format("1 to {} readings a pose", kMostFrames));
    tracker.frames = static_cast<int>(count);
  }
  return tracker;
}

InitialGuess ReadInitial(const YamlNode& node, const Units& units) {
  const MapReader map(node, "initial", {"base", "tool"});
  return {ReadPose(map.Required("base"), units, "the initial base"),
          ReadPose(map.Required("tool"), units, "the initial tool")};
}

// What a dataset may say beside its two tables.
void ReadSetting(const MapReader& map, const Units& units, Dataset& dataset) {
  if (const YamlNode* text = map.Optional("description"))
    dataset.description = text->kind == YamlNode::Kind::kNull ? "" : ReadText(*text);
  if (const YamlNode* gravity = map.Optional("gravity"))
    dataset.gravity_in_base = ReadGravity(*gravity);
  if (const YamlNode* hexapod = map.Optional("hexapod"))
    dataset.hexapod = ReadHexapodGeometry(*hexapod, units);
  if (const YamlNode* temperature = map.Optional("reference_temperature"))
    dataset.reference_temperature = ReadTemperature(*temperature);
  if (const YamlNode* tracker = map.Optional("tracker"))
    dataset.tracker = ReadTracker(*tracker, units);
  if (const YamlNode* initial = map.Optional("initial"))
    dataset.initial = ReadInitial(*initial, units);
}

}  // namespace

Matrix6d PoseNoise::Covariance() const {
  Vector6d variances;
  variances << position.cwiseAbs2(), orientation.cwiseAbs2();
  return variances.asDiagonal();
}

Dataset ReadDataset(const std::string& path, bool needs_measurement) {
  const YamlNode root = ParseYamlFile(path);
  CheckFormat(root, kFormat);
  const MapReader map(root,
                      "the dataset",
                      {"format",
                       "name",
                       "description",
                       "units",
                       "covariates",
                       "gravity",
                       "hexapod",
                       "reference_temperature",
                       "robot_poses",
                       "tracker",
                       "measurement",
                       "initial"});
  Dataset dataset;
  dataset.path = path;
  dataset.name = ReadName(map.Required("name"));
  const ReadContext context{path, ReadUnits(map.Required("units")), &dataset.warnings};
  ReadSetting(map, context.units, dataset);
  const HexapodGeometry* hexapod = dataset.hexapod ? &*dataset.hexapod : nullptr;
  dataset.robot_poses = ReadRobotPoses(
      map.Required("robot_poses"), ReadCovariates(map.Optional("covariates")), hexapod, context);
  if (needs_measurement || map.Has("measurement"))
    dataset.measurement = ReadMeasurement(map.Required("measurement"),
                                          dataset.robot_poses,
                                          dataset.tracker.is_static,
                                          needs_measurement,
                                          context);
  const std::vector<std::string> oddities = FindOddities(dataset);
  dataset.warnings.insert(dataset.warnings.end(), oddities.begin(), oddities.end());
  return dataset;
}

}  // namespace hexcal
