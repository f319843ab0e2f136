// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/dataset_writer.h"

#include <fmt/format.h>

#include <iterator>

#include "config/yaml_number.h"
#include "measurement/marker_body_reader.h"

namespace hexcal {
namespace {

constexpr const char* kPosesFile = "poses.csv";
constexpr const char* kMeasuredFile = "measured.csv";
constexpr const char* kMarkersFile = "markers.csv";

// Text in double quotes, as YAML reads it back whatever it holds: what is not printable ASCII or
// plain UTF-8 is escaped.
std::string QuotedYaml(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += fmt::format("\\{}", c);
    else if (byte < 0x20 || byte == 0x7f)
      quoted += fmt::format("\\x{:02x}", byte);
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string Numbers(const Eigen::Vector3d& v) { return YamlNumbers(v.data(), 3); }

std::string Noise(const PoseNoise& noise) {
  return fmt::format("  noise: {{position: {}, orientation: {}}}\n",
                     Numbers(noise.position),
                     Numbers(noise.orientation));
}

std::string RobotPosesMapping(const RobotPoses& robot_poses) {
  std::string text = fmt::format("robot_poses:\n  file: {}\n", kPosesFile);
  if (robot_poses.noise) text += Noise(*robot_poses.noise);
  if (robot_poses.leg_noise)
    text += fmt::format("  noise: {{leg: {}}}\n", YamlNumber(*robot_poses.leg_noise));
  return text;
}

std::string TrackerMapping(const Tracker& tracker) {
  std::string text =
      fmt::format("tracker:\n  static: {}\n  frames: {}\n", tracker.is_static, tracker.frames);
  if (tracker.tracker_from_world)
    text += fmt::format("  pose: {}\n", WritePose(*tracker.tracker_from_world));
  return text;
}

std::string BodyMapping(const MarkerBody& body, std::string_view name) {
  std::string text =
      fmt::format("    {}:\n      frame: {}\n", name, body.is_centroid ? "centroid" : "rigid");
  text += "      markers:\n";
  for (std::size_t i = 0; i < body.markers.size(); ++i) {
    const std::string marker = QuotedYaml(body.markers[i]);
    text += body.is_centroid
                ? fmt::format("        - {}\n", marker)
                : fmt::format("        {}: {}\n", marker, Numbers(body.p_in_body.col(i)));
  }
  if (body.is_centroid)
    text += fmt::format("      x_axis: [{}, {}]\n",
                        QuotedYaml(body.markers[body.x_axis[0]]),
                        QuotedYaml(body.markers[body.x_axis[1]]));
  return text;
}

std::string MeasurementMapping(const Measurement& measurement) {
  if (measurement.kind == Measurement::Kind::kPoses)
    return fmt::format("measurement:\n  kind: poses\n  file: {}\n{}",
                       kMeasuredFile,
                       measurement.pose_noise ? Noise(*measurement.pose_noise) : "");
  std::string text = fmt::format("measurement:\n  kind: markers\n  file: {}\n", kMarkersFile);
  if (measurement.marker_sigma)
    text += fmt::format("  noise: {{sigma: {}}}\n", Numbers(*measurement.marker_sigma));
  text += "  bodies:\n";
  for (int body = 0; body < 2; ++body)
    text += BodyMapping(measurement.bodies[body], kBodyNames[body]);
  return text;
}

std::string DatasetYaml(const Dataset& dataset) {
  std::string text = fmt::format("format: hexcal/dataset/1\nname: {}\n", QuotedYaml(dataset.name));
  if (!dataset.description.empty())
    text += fmt::format("description: {}\n", QuotedYaml(dataset.description));
  text += "units: {length: m, angle: rad}\n";
  if (!dataset.robot_poses.covariates.empty()) text += "covariates:\n";
  for (const Covariate& covariate : dataset.robot_poses.covariates)
    text += fmt::format("  {}: {}\n", QuotedYaml(covariate.name), covariate.unit.si_symbol);
  if (dataset.gravity_in_base)
    text += fmt::format("gravity: {}\n", Numbers(*dataset.gravity_in_base));
  if (dataset.hexapod) text += "hexapod:\n" + WriteHexapodGeometry(*dataset.hexapod, "  ");
  if (dataset.reference_temperature)
    text += fmt::format("reference_temperature: {}\n", YamlNumber(*dataset.reference_temperature));
  text += RobotPosesMapping(dataset.robot_poses);
  text += TrackerMapping(dataset.tracker);
  if (dataset.measurement) text += MeasurementMapping(*dataset.measurement);
  if (dataset.initial)
    text += fmt::format("initial:\n  base: {}\n  tool: {}\n",
                        WritePose(dataset.initial->world_from_base),
                        WritePose(dataset.initial->platform_from_tool));
  return text;
}

using Appender = std::back_insert_iterator<std::string>;

void AppendPose(const Pose3d& pose, Appender out) {
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond& q = pose.rotation;
  fmt::format_to(out, ",{},{},{},{},{},{},{}", t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

std::string PosesTable(const RobotPoses& robot_poses) {
  std::string text =
      robot_poses.are_leg_lengths ? "pose,l1,l2,l3,l4,l5,l6" : "pose,x,y,z,qw,qx,qy,qz";
  for (const Covariate& covariate : robot_poses.covariates) text += "," + covariate.name;
  text += '\n';
  const Appender out = std::back_inserter(text);
  for (std::size_t row = 0; row < robot_poses.rows.size(); ++row) {
    const RobotPose& pose = robot_poses.rows[row];
    text += pose.label;
    if (robot_poses.are_leg_lengths)
      for (const double length : pose.leg_lengths) fmt::format_to(out, ",{}", length);
    else
      AppendPose(pose.base_from_platform, out);
    for (const Covariate& covariate : robot_poses.covariates)
      fmt::format_to(out, ",{}", covariate.values[row]);
    text += '\n';
  }
  return text;
}

std::string MeasuredTable(const Dataset& dataset) {
  std::string text = "pose,x,y,z,qw,qx,qy,qz\n";
  for (const MeasuredPose& pose : dataset.measurement->poses) {
    text += dataset.robot_poses.rows[pose.pose].label;
    AppendPose(pose.world_from_tool, std::back_inserter(text));
    text += '\n';
  }
  return text;
}

std::string MarkersTable(const Dataset& dataset) {
  const Measurement& measurement = *dataset.measurement;
  const bool has_frames = !measurement.frame_labels.empty();
  std::string text = has_frames ? "pose,frame,body,marker,x,y,z\n" : "pose,body,marker,x,y,z\n";
  const Appender out = std::back_inserter(text);
  for (const MarkerReading& reading : measurement.readings) {
    const int body = static_cast<int>(reading.body);
    text += dataset.robot_poses.rows[reading.pose].label;
    if (has_frames) fmt::format_to(out, ",{}", measurement.frame_labels[reading.frame]);
    fmt::format_to(out,
                   ",{},{},{},{},{}\n",
                   kBodyNames[body],
                   measurement.bodies[body].markers[reading.marker],
                   reading.p_in_tracker.x(),
                   reading.p_in_tracker.y(),
                   reading.p_in_tracker.z());
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> WriteDataset(const Dataset& dataset) {
  std::vector<std::pair<std::string, std::string>> files;
  files.emplace_back("dataset.yaml", DatasetYaml(dataset));
  files.emplace_back(kPosesFile, PosesTable(dataset.robot_poses));
  if (!dataset.measurement) return files;
  if (dataset.measurement->kind == Measurement::Kind::kPoses)
    files.emplace_back(kMeasuredFile, MeasuredTable(dataset));
  else
    files.emplace_back(kMarkersFile, MarkersTable(dataset));
  return files;
}

}  // namespace hexcal
