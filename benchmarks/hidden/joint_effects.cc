// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "hidden/hidden_effect.h"

namespace hexcal::hidden {
namespace {

HiddenEffect Named(const std::string& name, const std::string& driver, double largest, int size) {
  HiddenEffect effect;
  effect.name = name;
  effect.right = {name};
  effect.driver = driver;
  effect.parameters = Eigen::VectorXd::Ones(size);
  effect.largest = Eigen::VectorXd::Constant(size, largest);
  return effect;
}

// All 18 coordinates, or the three of one joint.
HiddenEffect JointOffset(const std::string& name, bool is_base, Dice* dice) {
  const bool is_one = dice->Chance(0.5);
  const int joint = dice->Below(6);
  HiddenEffect effect = Named(name, "constant", 4e-3, is_one ? 3 : 18);
  effect.parameters = dice->Normals(is_one ? 3 : 18);
  if (is_one) effect.carriers = {joint + 1};
  effect.add = [=](const Scene&, const Row&, const Eigen::VectorXd& p, Additions* additions) {
    Joints* joints = is_base ? &additions->base : &additions->platform;
    if (is_one)
      joints->col(joint) += p;
    else
      *joints += Eigen::Map<const Joints>(p.data());
  };
  return effect;
}

HiddenEffect BaseJointOffset(const Scene&, const DetailOptions&, Dice* dice) {
  return JointOffset("base_joint_offset", true, dice);
}

HiddenEffect PlatformJointOffset(const Scene&, const DetailOptions&, Dice* dice) {
  return JointOffset("platform_joint_offset", false, dice);
}

HiddenEffect BaseRadius(const Scene&, const DetailOptions&, Dice* dice) {
  HiddenEffect effect = Named("base_radius", "constant", 4e-3, 1);
  effect.parameters *= dice->Sign();
  effect.add = [](const Scene& scene, const Row&, const Eigen::VectorXd& p, Additions* additions) {
    additions->base += p[0] * RadialAxes(scene.hexapod.base);
  };
  return effect;
}

HiddenEffect PlatformRadius(const Scene&, const DetailOptions&, Dice* dice) {
  HiddenEffect effect = Named("platform_radius", "constant", 4e-3, 1);
  effect.parameters *= dice->Sign();
  effect.add = [](const Scene& scene, const Row&, const Eigen::VectorXd& p, Additions* additions) {
    additions->platform += p[0] * RadialAxes(scene.hexapod.platform);
  };
  return effect;
}

// The leg swings about an axis that misses the joint's centre by the offset: it is drawn in by the
// cosine of its elevation over the first axis.
HiddenEffect JointAxisOffset(const Scene&, const DetailOptions&, Dice* dice) {
  const bool is_base = dice->Chance(0.5);
  HiddenEffect effect = Named("joint_axis_offset", "joint_angle", 5e-3, 1);
  effect.fixed = {{"is_base", is_base}};
  effect.add =
      [is_base](
          const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        const Hexapod& hexapod = scene.hexapod;
        const Joints u = LegDirections(hexapod.base, hexapod.platform, row.base_from_platform);
        const Joints axes = is_base ? hexapod.base_axes
                                    : Joints(row.base_from_platform.turn * hexapod.platform_axes);
        for (int i = 0; i < 6; ++i) {
          const double along = axes.col(i).dot(u.col(i));
          additions->leg[i] -= p[0] * std::sqrt(1.0 - along * along);
        }
      };
  return effect;
}

HiddenEffect PlateThermal(const Scene&, const DetailOptions&, Dice*) {
  HiddenEffect effect = Named("plate_thermal", "temperature", 3e-4, 1);
  effect.add =
      [](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        const double growth = p[0] * (row.temperature - scene.reference_temperature);
        additions->base += growth * scene.hexapod.base;
        additions->platform += growth * scene.hexapod.platform;
      };
  return effect;
}

}  // namespace

std::vector<EffectRow> JointEffects() {
  return {{"base_joint_offset", BaseJointOffset},
          {"platform_joint_offset", PlatformJointOffset},
          {"base_radius", BaseRadius},
          {"platform_radius", PlatformRadius},
          {"joint_axis_offset", JointAxisOffset},
          {"plate_thermal", PlateThermal}};
}

}  // namespace hexcal::hidden
