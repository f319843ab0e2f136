// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/write_case.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hidden/pose_fit.h"

namespace hexcal::hidden {
namespace {

template <typename V>
std::string Numbers(const V& v, const char* separator) {
  std::string text;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : separator, double(v[i]));
  return text;
}

template <typename M>
std::string Columns(const M& points) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    text +=
        fmt::format("{}[{}]", i == 0 ? "" : ", ", Numbers(Eigen::Vector3d(points.col(i)), ", "));
  return text + "]";
}

std::string Covariates(const Scene& scene) {
  std::string text = "time: s, temperature: degC, payload: kg";
  if (scene.tells_payload_centre) text += ", payload_x: m, payload_y: m, payload_z: m";
  if (scene.tells_velocity) text += ", vx: m/s, vy: m/s, vz: m/s, wx: rad/s, wy: rad/s, wz: rad/s";
  if (scene.tells_direction)
    for (int i = 1; i <= 6; ++i) text += fmt::format(", direction_{}: 1", i);
  return text;
}

std::string Body(const std::string& name, char prefix, const Markers& markers) {
  std::string text = fmt::format("    {}: {{frame: rigid, markers: {{", name);
  for (int m = 0; m < 4; ++m)
    text += fmt::format("{}{}{}: [{}]",
                        m == 0 ? "" : ", ",
                        prefix,
                        m + 1,
                        Numbers(Eigen::Vector3d(markers.col(m)), ", "));
  return text + "}}\n";
}

std::string DatasetYaml(const Case& made, bool is_heldout) {
  const Scene& scene = made.scene;
  std::string text = fmt::format(
      "format: hexcal/dataset/1\nname: {}\nunits: {{length: m, angle: rad}}\ncovariates: {{{}}}\n"
      "gravity: [{}]\nhexapod:\n  base_joints: {}\n  platform_joints: {}\n",
      made.name,
      Covariates(scene),
      Numbers(scene.gravity, ", "),
      Columns(scene.hexapod.base),
      Columns(scene.hexapod.platform));
  if (scene.tells_axes)
    text += fmt::format("  base_axes: {}\n  platform_axes: {}\n",
                        Columns(scene.hexapod.base_axes),
                        Columns(scene.hexapod.platform_axes));
  if (scene.tells_home) text += fmt::format("  home: [{}]\n", Numbers(scene.home_vector, ", "));
  text += "robot_poses: {file: poses.csv}\n";
  if (is_heldout) return text;
  if (scene.tracker_is_static) text += "tracker: {static: true}\n";
  return text +
         fmt::format(
             "measurement:\n  kind: markers\n  file: markers.csv\n  noise: {{sigma: [{}]}}\n"
             "  bodies:\n",
             Numbers(scene.sigma, ", ")) +
         Body("base", 'b', scene.base_markers) + Body("tool", 't', scene.tool_markers);
}

std::string PosesCsv(const Scene& scene) {
  std::string text = "pose,x,y,z,rx,ry,rz,time,temperature,payload";
  if (scene.tells_payload_centre) text += ",payload_x,payload_y,payload_z";
  if (scene.tells_velocity) text += ",vx,vy,vz,wx,wy,wz";
  if (scene.tells_direction)
    for (int i = 1; i <= 6; ++i) text += fmt::format(",direction_{}", i);
  text += "\n";
  for (const Row& row : scene.rows) {
    text += fmt::format("{},{},{},{},{}",
                        row.label,
                        Numbers(row.vector, ","),
                        row.time,
                        row.temperature,
                        row.payload);
    if (scene.tells_payload_centre) text += "," + Numbers(row.payload_centre, ",");
    if (scene.tells_velocity) text += "," + Numbers(row.velocity, ",");
    if (scene.tells_direction)
      for (const double move : row.last_move) text += move < 0 ? ",-1" : ",1";
    text += "\n";
  }
  return text;
}

std::string MarkersCsv(const Case& made) {
  std::string text = "pose,body,marker,x,y,z\n";
  std::size_t next = 0;
  for (const Row& row : made.scene.rows) {
    if (!row.is_measured) continue;
    const Reading& reading = made.readings[next++];
    for (int m = 0; m < 8; ++m)
      text += fmt::format("{},{},{}{},{}\n",
                          row.label,
                          m < 4 ? "base" : "tool",
                          m < 4 ? 'b' : 't',
                          m % 4 + 1,
                          Numbers(Eigen::Vector3d(reading.segment<3>(3 * m)), ","));
  }
  return text;
}

std::string TruthCsv(const Case& made) {
  std::string text = "pose,x,y,z,qw,qx,qy,qz\n";
  for (const Row& row : made.scene.rows) {
    if (row.is_measured) continue;
    const Motion tool = TrueTool(made.scene, row, Sum(made.effects, made.scene, row));
    text += fmt::format(
        "{},{},{}\n", row.label, Numbers(tool.shift, ","), Numbers(QuaternionOf(tool.turn), ","));
  }
  return text;
}

std::string TruthJson(const Case& made, const CaseOptions& options) {
  // Pose by pose, the tracker's pose free in each.
  Scene scene = made.scene;
  scene.tracker_is_static = false;
  const Fit fit = FitMounts(scene, {}, made.readings);
  nlohmann::ordered_json truth;
  truth["effects"] = nlohmann::ordered_json::object();
  truth["expect"] = nlohmann::json::array();
  truth["legs"] = nullptr;
  truth["driver"] = nullptr;
  for (const HiddenEffect& effect : made.effects) {
    auto& told = truth["effects"][effect.name];
    told["parameters"] = std::vector<double>(effect.parameters.begin(), effect.parameters.end());
    for (const auto& [name, value] : effect.fixed) told[name] = value;
    truth["expect"].push_back(effect.is_listed ? effect.name : "unknown");
    if (!effect.carriers.empty()) truth["legs"] = effect.carriers;
    if (!effect.is_listed) truth["driver"] = effect.driver;
  }
  if (made.effects.empty()) truth["expect"].push_back("none");
  truth["chi2"] = fit.pose_chi_square;
  truth["dof"] = 6 * fit.poses - 12;
  truth["gap_base_tool_only"] = HeldoutRms(fit, made.scene, made.effects);
  truth["noise_floor"] = NoiseFloor(scene);
  truth["sigma"] = std::vector<double>(made.scene.sigma.begin(), made.scene.sigma.end());
  truth["strength"] = nullptr;
  if (!made.effects.empty()) truth["strength"] = fmt::format("SNR {}", options.snr);
  return truth.dump(1) + "\n";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> CaseFiles(const Case& made,
                                                           const CaseOptions& options) {
  return {{"dataset.yaml", DatasetYaml(made, false)},
          {"poses.csv", PosesCsv(made.scene)},
          {"markers.csv", MarkersCsv(made)},
          {"heldout/dataset.yaml", DatasetYaml(made, true)},
          {"heldout/poses.csv", PosesCsv(made.scene)},
          {"heldout/truth.csv", TruthCsv(made)},
          {"truth.json", TruthJson(made, options)}};
}

}  // namespace hexcal::hidden
