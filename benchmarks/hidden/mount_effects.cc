// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>

#include "hidden/hidden_effect.h"

namespace hexcal::hidden {
namespace {

HiddenEffect Named(const std::string& name, const std::string& driver) {
  HiddenEffect effect;
  effect.name = name;
  effect.right = {name};
  effect.driver = driver;
  return effect;
}

enum class Mount { kBase, kTool };

// A twist of a mount that follows a number of the row.
HiddenEffect TwistThatFollows(const std::string& name,
                              const std::string& driver,
                              Mount mount,
                              double largest,
                              const std::function<double(const Scene&, const Row&)>& follows,
                              Dice* dice) {
  HiddenEffect effect = Named(name, driver);
  effect.parameters = dice->Normals(6);
  effect.parameters.head<3>() *= 0.4;  // a lever of some 0.4 m
  effect.largest = Eigen::VectorXd::Constant(6, largest);
  effect.add =
      [=](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        (mount == Mount::kBase ? additions->base_twist : additions->tool_twist) +=
            follows(scene, row) * Six(p);
      };
  return effect;
}

double Elapsed(const Scene& scene, const Row& row) {
  return (row.time - scene.FirstTime()) / scene.TimeSpan();
}

HiddenEffect BaseDrift(const Scene&, const DetailOptions&, Dice* dice) {
  return TwistThatFollows("base_drift", "time", Mount::kBase, 6e-3, Elapsed, dice);
}

HiddenEffect ToolDrift(const Scene&, const DetailOptions&, Dice* dice) {
  return TwistThatFollows("tool_drift", "time", Mount::kTool, 6e-3, Elapsed, dice);
}

HiddenEffect Step(const std::string& name, Mount mount, const Scene& scene, Dice* dice) {
  const double at = scene.FirstTime() + dice->Uniform(0.2, 0.8) * scene.TimeSpan();
  const auto follows = [at](const Scene&, const Row& row) { return row.time > at ? 1.0 : 0.0; };
  HiddenEffect effect = TwistThatFollows(name, "time", mount, 6e-3, follows, dice);
  effect.fixed = {{"time", at}};
  return effect;
}

HiddenEffect BaseStep(const Scene& scene, const DetailOptions&, Dice* dice) {
  return Step("base_step", Mount::kBase, scene, dice);
}

HiddenEffect ToolStep(const Scene& scene, const DetailOptions&, Dice* dice) {
  return Step("tool_step", Mount::kTool, scene, dice);
}

HiddenEffect ToolThermal(const Scene&, const DetailOptions&, Dice* dice) {
  return TwistThatFollows(
      "tool_thermal",
      "temperature",
      Mount::kTool,
      5e-4,
      [](const Scene& scene, const Row& row) {
        return row.temperature - scene.reference_temperature;
      },
      dice);
}

// The frame yields about the base's origin to the moment of the load.
HiddenEffect BaseFlexure(const Scene&, const DetailOptions&, Dice*) {
  HiddenEffect effect = Named("base_flexure", "moment");
  effect.parameters = Eigen::VectorXd::Ones(1);
  effect.largest = Eigen::VectorXd::Constant(1, 1e-3);
  effect.add =
      [](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        const Eigen::Vector3d weight = 9.80665 * row.payload * scene.gravity;
        additions->base_twist.tail<3>() += p[0] * row.base_from_platform.shift.cross(weight);
      };
  return effect;
}

// The tool gives way along gravity and tips over, both as the platform sees gravity.
HiddenEffect ToolSag(const Scene&, const DetailOptions&, Dice* dice) {
  HiddenEffect effect = Named("tool_sag", "gravity");
  effect.parameters = Eigen::Vector2d(0.3 * dice->Uniform(0.2, 1), dice->Uniform(0.2, 1));
  effect.largest = Eigen::VectorXd::Constant(2, 6e-3);
  effect.add =
      [](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        const Eigen::Vector3d down = row.base_from_platform.turn.transpose() * scene.gravity;
        Six twist;
        twist << p[0] * down, p[1] * Eigen::Vector3d::UnitZ().cross(down);
        additions->tool_twist += twist;
      };
  return effect;
}

HiddenEffect Latency(const Scene&, const DetailOptions&, Dice*) {
  HiddenEffect effect = Named("latency", "velocity");
  effect.parameters = Eigen::VectorXd::Ones(1);
  effect.largest = Eigen::VectorXd::Constant(1, 0.1);
  effect.add = [](const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
    additions->platform_twist += p[0] * row.velocity;
  };
  return effect;
}

}  // namespace

std::vector<EffectRow> MountEffects() {
  return {{"base_drift", BaseDrift},
          {"tool_drift", ToolDrift},
          {"base_step", BaseStep},
          {"tool_step", ToolStep},
          {"base_flexure", BaseFlexure},
          {"tool_sag", ToolSag},
          {"tool_thermal", ToolThermal},
          {"latency", Latency}};
}

}  // namespace hexcal::hidden
