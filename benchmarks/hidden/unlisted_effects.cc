// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "hidden/hidden_effect.h"

// Effects that no name of the library fits. `right` holds the names at the same site: one of these
// is not the truth, but sends the user to the right place.
namespace hexcal::hidden {
namespace {

using Add = decltype(HiddenEffect::add);

const std::vector<std::string> kLeg = {"leg_offset",
                                       "leg_gain",
                                       "leg_nonlinearity",
                                       "leg_periodic",
                                       "leg_screw_rotation",
                                       "leg_backlash",
                                       "leg_thermal",
                                       "leg_compliance",
                                       "leg_clearance",
                                       "settling"};
const std::vector<std::string> kBase = {"base_drift", "base_step", "base_flexure"};
const std::vector<std::string> kTool = {"tool_drift", "tool_step", "tool_sag", "tool_thermal"};
const std::vector<std::string> kTracker = {
    "tracker_scale", "tracker_depth_scale", "tracker_distortion", "tracker_warmup"};

HiddenEffect Unlisted(const std::string& name,
                      const std::string& driver,
                      const std::vector<std::string>& right,
                      const Eigen::VectorXd& parameters,
                      double largest,
                      const Add& add) {
  HiddenEffect effect;
  effect.name = name;
  effect.is_listed = false;
  effect.right = right;
  effect.driver = driver;
  effect.parameters = parameters;
  effect.largest = Eigen::VectorXd::Constant(parameters.size(), largest);
  effect.add = add;
  return effect;
}

double Warmer(const Scene& scene, const Row& row) {
  return row.temperature - scene.reference_temperature;
}

Eigen::VectorXd Twist(Dice* dice) {
  Eigen::VectorXd twist = dice->Normals(6);
  twist.head<3>() *= 0.4;
  return twist;
}

// The stand bends with the square of the temperature.
HiddenEffect BaseWarmthSquared(const Scene&, const DetailOptions&, Dice* dice) {
  return Unlisted(
      "base_twist_by_temperature_squared",
      "temperature",
      kBase,
      Twist(dice),
      1e-3,
      [](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->base_twist += std::pow(Warmer(scene, row), 2) * Six(p);
      });
}

// A cable pulls at the tool as the platform goes to and fro.
HiddenEffect ToolCable(const Scene& scene, const DetailOptions&, Dice* dice) {
  const int axis = dice->Below(2);
  const double wave = scene.home.shift.norm() * dice->Uniform(0.15, 0.3);
  return Unlisted(
      "tool_twist_by_sine_of_position",
      "pose",
      kTool,
      Twist(dice),
      6e-3,
      [axis, wave](const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->tool_twist +=
            std::sin(2 * M_PI * row.base_from_platform.shift[axis] / wave) * Six(p);
      });
}

// The screws' lead errs with the cube of the stroke.
HiddenEffect LegCubic(const Scene& scene, const DetailOptions&, Dice* dice) {
  const LegPattern pattern = DrawLegPattern(0.2, 0.4, dice);
  const Six home = LegLengths(scene.hexapod.base, scene.hexapod.platform, scene.home);
  HiddenEffect effect = Unlisted(
      "leg_cubic",
      "leg_length",
      kLeg,
      pattern.parameters,
      50.0,
      [spread = pattern.spread, home](
          const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->leg += Six(spread * p).cwiseProduct(Six((row.lengths - home).array().cube()));
      });
  effect.carriers = pattern.carriers;
  return effect;
}

// One leg's reference creeps away.
HiddenEffect LegCreep(const Scene&, const DetailOptions&, Dice* dice) {
  const int leg = dice->Below(6);
  HiddenEffect effect = Unlisted(
      "leg_creep",
      "time",
      kLeg,
      Eigen::VectorXd::Constant(1, dice->Sign()),
      2e-3,
      [leg](const Scene& scene, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->leg[leg] += p[0] * (row.time - scene.FirstTime()) / scene.TimeSpan();
      });
  effect.carriers = {leg + 1};
  return effect;
}

// Friction in the joints winds the legs up: their play closes gradually with the last move.
HiddenEffect LegWindUp(const Scene& scene, const DetailOptions&, Dice*) {
  const double width = 0.05 * scene.home.shift.norm();
  return Unlisted(
      "leg_wind_up",
      "leg_direction",
      kLeg,
      Eigen::VectorXd::Ones(1),
      1e-3,
      [width](const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
        additions->leg += p[0] * Six((row.last_move.array() / width).tanh());
      });
}

// The tool's plate buckles with the square of the load.
HiddenEffect ToolLoadSquared(const Scene&, const DetailOptions&, Dice* dice) {
  return Unlisted("tool_twist_by_payload_squared",
                  "payload",
                  kTool,
                  Twist(dice),
                  1e-3,
                  [](const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
                    additions->tool_twist += row.payload * row.payload * Six(p);
                  });
}

// The stand leans with the load, wherever it stands.
HiddenEffect BaseLoad(const Scene&, const DetailOptions&, Dice* dice) {
  return Unlisted("base_twist_by_payload",
                  "payload",
                  kBase,
                  Twist(dice),
                  3e-3,
                  [](const Scene&, const Row& row, const Eigen::VectorXd& p, Additions* additions) {
                    additions->base_twist += row.payload * Six(p);
                  });
}

HiddenEffect Reading(const std::string& name,
                     const std::string& driver,
                     double largest,
                     const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& misread,
                     Dice* dice) {
  return Unlisted(
      name,
      driver,
      kTracker,
      Eigen::VectorXd::Constant(1, dice->Sign()),
      largest,
      [misread](const Scene&, const Row&, const Eigen::VectorXd& p, Additions* additions) {
        additions->misreadings.push_back([misread, size = p[0]](const Eigen::Vector3d& point) {
          return Eigen::Vector3d(size * misread(point));
        });
      });
}

// A lens that distorts by the angle from its axis to the fifth power, tangentially.
HiddenEffect TrackerTangential(const Scene&, const DetailOptions&, Dice* dice) {
  return Reading(
      "tracker_tangential_distortion",
      "off_axis_distance",
      0.1,
      [](const Eigen::Vector3d& point) {
        const Eigen::Vector2d off = point.head<2>() / point.z();
        return Eigen::Vector3d(point.z() * off.squaredNorm() *
                               Eigen::Vector3d(-off.y(), off.x(), 0));
      },
      dice);
}

// A bias that waves through the volume.
HiddenEffect TrackerWave(const Scene&, const DetailOptions&, Dice* dice) {
  const double wave = dice->Uniform(0.1, 0.3);
  return Reading(
      "tracker_wave",
      "position",
      3e-3,
      [wave](const Eigen::Vector3d& point) {
        return Eigen::Vector3d(
            std::sin(2 * M_PI * point.y() / wave), std::sin(2 * M_PI * point.x() / wave), 0);
      },
      dice);
}

}  // namespace

const std::vector<EffectRow>& UnlistedEffects() {
  static const std::vector<EffectRow> all = {
      {"base_twist_by_temperature_squared", BaseWarmthSquared},
      {"tool_twist_by_sine_of_position", ToolCable},
      {"leg_cubic", LegCubic},
      {"leg_creep", LegCreep},
      {"leg_wind_up", LegWindUp},
      {"tool_twist_by_payload_squared", ToolLoadSquared},
      {"base_twist_by_payload", BaseLoad},
      {"tracker_tangential_distortion", TrackerTangential},
      {"tracker_wave", TrackerWave}};
  return all;
}

}  // namespace hexcal::hidden
