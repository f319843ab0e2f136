// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/scene.h"

#include <algorithm>
#include <cmath>

namespace hexcal::hidden {
namespace {

Eigen::Vector3d Box(Dice* dice, double half_width) {
  return {dice->Uniform(-half_width, half_width),
          dice->Uniform(-half_width, half_width),
          dice->Uniform(-half_width, half_width)};
}

Eigen::Matrix3d AnyTurn(Dice* dice, double largest) {
  const Eigen::Vector3d axis = dice->Normals(3);
  return TurnBy(dice->Uniform(0, largest) * axis.normalized());
}

Joints PlateJoints(double radius, double half_pair, double shift, double unevenness, Dice* dice) {
  Joints joints;
  for (int i = 0; i < 6; ++i) {
    // Legs 1 and 6, 2 and 3, 4 and 5 are neighbours on the base, 1 and 2 ... on the platform.
    const int third = (i + 1) / 2 % 3;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double angle = 2.0 * M_PI / 3.0 * third + sign * (half_pair + shift);
    joints.col(i) << radius * std::cos(angle), radius * std::sin(angle), 0.0;
    joints.col(i) += unevenness * radius * dice->Normals(3);
  }
  return joints;
}

Hexapod DrawHexapod(double radius, bool tells_axes, Dice* dice) {
  constexpr double kDegree = M_PI / 180.0;
  const double unevenness = dice->Chance(0.5) ? dice->Uniform(0.0, 0.02) : 0.0;
  Hexapod hexapod;
  hexapod.base = PlateJoints(radius, dice->Uniform(8, 20) * kDegree, 0.0, unevenness, dice);
  // On the platform the joints stand near the middle between two pairs of the base.
  hexapod.platform = PlateJoints(radius * dice->Uniform(0.4, 0.7),
                                 -dice->Uniform(10, 20) * kDegree,
                                 60.0 * kDegree,
                                 unevenness,
                                 dice);
  hexapod.base_axes = RadialAxes(hexapod.base);
  hexapod.platform_axes = RadialAxes(hexapod.platform);
  if (!tells_axes) return hexapod;
  for (Joints* axes : {&hexapod.base_axes, &hexapod.platform_axes})
    for (int i = 0; i < 6; ++i) axes->col(i) = AnyTurn(dice, 0.6) * axes->col(i);
  return hexapod;
}

// Mostly cycled, as good practice asks; else drifting with the time.
void DrawTemperatures(Scene* scene, Dice* dice) {
  const bool is_cycled = dice->Chance(0.7);
  const double range = dice->Uniform(4, 9), cycles = dice->Uniform(2.3, 6), phase = dice->Normal();
  for (Row& row : scene->rows) {
    const double part = (row.time - scene->FirstTime()) / scene->TimeSpan();
    const double shape = is_cycled ? 0.5 * std::sin(2 * M_PI * cycles * part + phase) : part;
    row.temperature = 22.0 + range * shape + 0.15 * dice->Normal();
  }
  scene->reference_temperature = 0.0;
  for (const Row& row : scene->rows)
    scene->reference_temperature += row.temperature / static_cast<double>(scene->rows.size());
}

void DrawPayloads(const SceneOptions& options, double radius, Scene* scene, Dice* dice) {
  const double factor = dice->Chance(0.5) ? 1.0 : 2.0;
  constexpr double kLoads[] = {0.5, 2.0, 4.0};
  scene->tells_payload_centre = options.is_extreme || dice->Chance(0.2);
  for (Row& row : scene->rows) {
    row.payload = factor * kLoads[dice->Below(3)];
    if (!scene->tells_payload_centre) continue;
    const double reach = options.is_extreme ? 2.5 * radius : 0.2 * radius;
    row.payload_centre << dice->Uniform(-reach, reach), dice->Uniform(-reach, reach),
        dice->Uniform(0, 0.5 * radius);
  }
}

void DrawRows(const SceneOptions& options, double height, Scene* scene, Dice* dice) {
  const double reach = height * dice->Uniform(0.13, 0.2), turn = dice->Uniform(0.14, 0.22);
  Six half_widths;
  half_widths << reach, reach, 0.7 * reach, turn, turn, 2.0 * turn;
  const int measured = options.measured > 0 ? options.measured : 60 + dice->Below(13);
  std::vector<bool> is_measured(measured, true);
  is_measured.resize(measured + options.visited_only, false);
  for (std::size_t i = is_measured.size() - 1; i > 0; --i) {
    const int j = dice->Below(static_cast<int>(i) + 1);
    const bool swapped = is_measured[i];
    is_measured[i] = is_measured[j];
    is_measured[j] = swapped;
  }
  double time = 0.0;
  for (const bool measure : is_measured) {
    Row row;
    row.label = std::to_string(scene->rows.size());
    row.is_measured = measure;
    for (int k = 0; k < 6; ++k) row.vector[k] = dice->Uniform(-half_widths[k], half_widths[k]);
    row.vector[2] += height;
    row.base_from_platform = FromPoseVector(row.vector);
    row.time = time += dice->Uniform(18, 32);
    scene->rows.push_back(row);
  }
}

// The centre of the travel: told, or what a reader of the dataset takes for it, the mean.
void SetHome(double height, Scene* scene, Dice* dice) {
  scene->tells_home = dice->Chance(0.5);
  scene->home_vector = height * Six::Unit(2);
  if (!scene->tells_home) {
    scene->home_vector.setZero();
    for (const Row& row : scene->rows)
      scene->home_vector += row.vector / static_cast<double>(scene->rows.size());
  }
  scene->home = FromPoseVector(scene->home_vector);
}

void SetMoves(Scene* scene) {
  const Hexapod& hexapod = scene->hexapod;
  Six before = LegLengths(hexapod.base, hexapod.platform, scene->home);
  for (Row& row : scene->rows) {
    row.lengths = LegLengths(hexapod.base, hexapod.platform, row.base_from_platform);
    row.last_move = row.lengths - before;
    before = row.lengths;
  }
}

Markers DrawBody(const Markers& usual, Dice* dice) {
  Markers markers = dice->Uniform(0.8, 1.6) * usual;
  const double size = markers.cwiseAbs().maxCoeff();
  for (int m = 0; m < 4; ++m) markers.col(m) += 0.1 * size * dice->Normals(3);
  return markers;
}

void DrawMounts(double radius, Scene* scene, Dice* dice) {
  const double turn = dice->Chance(0.5) ? 0.5 : M_PI;
  scene->world_from_base = {AnyTurn(dice, turn), 1.5 * Box(dice, radius)};
  scene->platform_from_tool = {AnyTurn(dice, turn),
                               Box(dice, 0.05) + Eigen::Vector3d(0, 0, dice->Uniform(0.05, 0.15))};
  Markers base, tool;
  base << 0.14, -0.07, -0.07, 0, 0, 0.12, -0.12, 0.05, 0, 0, 0, 0.06;
  tool << 0.05, -0.03, -0.03, 0, 0, 0.045, -0.045, 0, 0, 0, 0, 0.05;
  scene->base_markers = DrawBody(base, dice);
  scene->tool_markers = DrawBody(tool, dice);
}

// It looks along its z axis at the platform from 1 to 3 m, and not quite in the middle.
void PlaceTracker(const SceneOptions& options, Scene* scene, Dice* dice) {
  scene->tracker_is_static = options.is_static;
  const double range = dice->Uniform(1.0, 3.0);
  const Eigen::Vector3d platform_in_world = scene->world_from_base * scene->home.shift;
  Motion tracker_from_world{AnyTurn(dice, M_PI), Eigen::Vector3d::Zero()};
  const Eigen::Vector3d aim(
      range * dice->Uniform(-0.2, 0.2), range * dice->Uniform(-0.2, 0.2), range);
  tracker_from_world.shift = aim - tracker_from_world * platform_in_world;
  const bool wobbles = !options.is_static && dice->Chance(0.5);
  for (Row& row : scene->rows) {
    row.tracker_from_world = tracker_from_world;
    if (!wobbles) continue;
    Six twist = dice->Normals(6);
    twist.head<3>() *= 3e-4;
    twist.tail<3>() *= 1e-4;
    row.tracker_from_world = Moved(tracker_from_world, twist);
  }
}

}  // namespace

int Scene::MeasuredRows() const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [](const Row& row) { return row.is_measured; }));
}

Scene DrawScene(const SceneOptions& options, Dice* dice) {
  const bool is_small =
      options.size == Size::kSmall || (options.size == Size::kAny && dice->Chance(0.5));
  const double radius = is_small ? dice->Uniform(0.1, 0.2) : dice->Uniform(0.2, 0.4);
  const double height = radius * dice->Uniform(1.0, 1.6);
  Scene scene;
  scene.tells_axes = options.has_axes || dice->Chance(0.2);
  scene.hexapod = DrawHexapod(radius, scene.tells_axes, dice);
  DrawRows(options, height, &scene, dice);
  SetHome(height, &scene, dice);
  SetMoves(&scene);
  DrawTemperatures(&scene, dice);
  DrawPayloads(options, radius, &scene, dice);
  scene.tells_direction = dice->Chance(0.2);
  scene.tells_velocity = options.has_velocity || dice->Chance(0.2);
  if (scene.tells_velocity)
    for (Row& row : scene.rows) row.velocity << 0.02 * dice->Normals(3), 0.05 * dice->Normals(3);
  scene.gravity =
      (-Eigen::Vector3d::UnitZ() + 0.15 * Eigen::Vector3d(dice->Normals(3))).normalized();
  DrawMounts(radius, &scene, dice);
  PlaceTracker(options, &scene, dice);
  const double sigma = options.sigma > 0 ? options.sigma : dice->LogUniform(3e-6, 150e-6);
  scene.sigma << sigma, sigma, 2.0 * sigma;
  return scene;
}

}  // namespace hexcal::hidden
