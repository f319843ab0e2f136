// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/as_dataset.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace hexcal::hidden {
namespace {

Covariate Column(const Scene& scene,
                 const std::string& name,
                 const char* unit,
                 const std::function<double(const Row&)>& value) {
  Covariate covariate{name, *FindCovariateUnit(unit), {}};
  for (const Row& row : scene.rows) covariate.values.push_back(value(row));
  return covariate;
}

std::vector<Covariate> Covariates(const Scene& scene) {
  std::vector<Covariate> all;
  const auto add = [&](const std::string& name, const char* unit, auto value) {
    all.push_back(Column(scene, name, unit, value));
  };
  add("time", "s", [](const Row& row) { return row.time; });
  add("temperature", "degC", [](const Row& row) { return row.temperature; });
  add("payload", "kg", [](const Row& row) { return row.payload; });
  const char* const axes[] = {"payload_x", "payload_y", "payload_z"};
  for (int k = 0; scene.tells_payload_centre && k < 3; ++k)
    add(axes[k], "m", [k](const Row& row) { return row.payload_centre[k]; });
  const char* const speeds[] = {"vx", "vy", "vz", "wx", "wy", "wz"};
  for (int k = 0; scene.tells_velocity && k < 6; ++k)
    add(speeds[k], k < 3 ? "m/s" : "rad/s", [k](const Row& row) { return row.velocity[k]; });
  for (int i = 0; scene.tells_direction && i < 6; ++i)
    add("direction_" + std::to_string(i + 1), "1", [i](const Row& row) {
      return row.last_move[i] < 0 ? -1.0 : 1.0;
    });
  return all;
}

MarkerBody Body(char prefix, const Markers& markers) {
  MarkerBody body;
  for (int m = 1; m <= 4; ++m) body.markers.push_back(prefix + std::to_string(m));
  body.p_in_body = markers;
  return body;
}

Dataset WithoutMeasurement(const Case& made) {
  const Scene& scene = made.scene;
  Dataset dataset;
  dataset.path = "dataset.yaml";
  dataset.name = made.name;
  dataset.gravity_in_base = scene.gravity;
  HexapodGeometry& hexapod = dataset.hexapod.emplace();
  hexapod.base_joints_in_base = scene.hexapod.base;
  hexapod.platform_joints_in_platform = scene.hexapod.platform;
  if (scene.tells_axes) {
    hexapod.base_axes_in_base = scene.hexapod.base_axes;
    hexapod.platform_axes_in_platform = scene.hexapod.platform_axes;
  }
  if (scene.tells_home) {
    hexapod.home = AsPose(scene.home);
    hexapod.home_vector = scene.home_vector;
  }
  dataset.robot_poses.where = FileLocation("poses.csv");
  for (const Row& row : scene.rows) {
    const int line = static_cast<int>(dataset.robot_poses.rows.size()) + 2;
    dataset.robot_poses.rows.push_back({row.label, AsPose(row.base_from_platform), {}, line});
  }
  dataset.robot_poses.covariates = Covariates(scene);
  return dataset;
}

}  // namespace

Pose3d AsPose(const Motion& motion) {
  return {motion.shift, Eigen::Quaterniond(motion.turn).normalized()};
}

Motion AsMotion(const Pose3d& pose) { return {pose.rotation.toRotationMatrix(), pose.translation}; }

Dataset AsDataset(const Case& made) {
  Dataset dataset = WithoutMeasurement(made);
  dataset.tracker.is_static = made.scene.tracker_is_static;
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.bodies = {Body('b', made.scene.base_markers), Body('t', made.scene.tool_markers)};
  measurement.marker_sigma = made.scene.sigma;
  measurement.where = FileLocation("markers.csv");
  std::size_t next = 0;
  for (std::size_t i = 0; i < made.scene.rows.size(); ++i) {
    if (!made.scene.rows[i].is_measured) continue;
    const Reading& reading = made.readings[next++];
    for (int m = 0; m < 8; ++m)
      measurement.readings.push_back({static_cast<int>(i),
                                      0,
                                      m < 4 ? BodyId::kBase : BodyId::kTool,
                                      m % 4,
                                      reading.segment<3>(3 * m)});
  }
  return dataset;
}

Dataset AsPoseDataset(const Case& made, Dice* dice) {
  const Scene& scene = made.scene;
  Dataset dataset = WithoutMeasurement(made);
  Measurement& measurement = dataset.measurement.emplace();
  measurement.kind = Measurement::Kind::kPoses;
  measurement.where = FileLocation("measured.csv");
  const Motion& tracker_from_world = scene.rows.front().tracker_from_world;
  // One noise for all, without correlations: what the first row's pose is uncertain by in one
  // number where the other five are known.
  const Eigen::Matrix<double, 6, 6> seen = SeenPoseCovariance(scene, scene.rows.front());
  const Six sigma = seen.inverse().diagonal().cwiseSqrt().cwiseInverse();
  measurement.pose_noise = PoseNoise{sigma.head<3>(), sigma.tail<3>()};
  for (std::size_t i = 0; i < scene.rows.size(); ++i) {
    const Row& row = scene.rows[i];
    if (!row.is_measured) continue;
    const Additions additions = Sum(made.effects, scene, row);
    Motion tool = tracker_from_world * TrueTool(scene, row, additions);
    Eigen::Vector3d shift = tool.shift;
    for (const auto& misreading : additions.misreadings) shift += misreading(tool.shift);
    tool.shift = shift;
    const Six noise = sigma.cwiseProduct(Six(dice->Normals(6)));
    measurement.poses.push_back({static_cast<int>(i), AsPose(Moved(tool, noise))});
  }
  return dataset;
}

}  // namespace hexcal::hidden
