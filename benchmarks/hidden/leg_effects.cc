// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "hidden/hidden_effect.h"

namespace hexcal::hidden {
namespace {

// What an effect of the legs adds to their lengths, m, is spread * parameters times this.
using LegShape = std::function<Six(const Scene&, const Row&)>;

HiddenEffect OfLegs(const std::string& name,
                    const std::string& driver,
                    const LegPattern& pattern,
                    double largest,
                    const LegShape& shape) {
  HiddenEffect effect;
  effect.name = name;
  effect.right = {name};
  effect.driver = driver;
  effect.carriers = pattern.carriers;
  effect.parameters = pattern.parameters;
  effect.largest = Eigen::VectorXd::Constant(pattern.parameters.size(), largest);
  effect.add = [spread = pattern.spread, shape](const Scene& scene,
                                                const Row& row,
                                                const Eigen::VectorXd& parameters,
                                                Additions* additions) {
    additions->leg += Six(spread * parameters).cwiseProduct(shape(scene, row));
  };
  return effect;
}

// One parameter, with the same share for all legs or nearly so.
LegPattern Common(double unequal, Dice* dice) {
  LegPattern pattern;
  pattern.spread = Eigen::MatrixXd::Ones(6, 1) + unequal * dice->Normals(6);
  pattern.parameters = Eigen::VectorXd::Constant(1, 1.0);
  return pattern;
}

Six Stroke(const Scene& scene, const Row& row) {
  return row.lengths - LegLengths(scene.hexapod.base, scene.hexapod.platform, scene.home);
}

HiddenEffect Offset(const Scene&, const DetailOptions&, Dice* dice) {
  return OfLegs("leg_offset",
                "constant",
                DrawLegPattern(0.1, 0.45, dice),
                2e-3,
                [](const Scene&, const Row&) { return Six(Six::Ones()); });
}

HiddenEffect Gain(const Scene&, const DetailOptions&, Dice* dice) {
  return OfLegs("leg_gain", "leg_length", DrawLegPattern(0.3, 0.35, dice), 5e-3, Stroke);
}

HiddenEffect Nonlinearity(const Scene&, const DetailOptions&, Dice* dice) {
  return OfLegs(
      "leg_nonlinearity",
      "leg_length",
      DrawLegPattern(0.3, 0.35, dice),
      1.0,
      [](const Scene& scene, const Row& row) { return Six(Stroke(scene, row).cwiseAbs2()); });
}

// Sine and cosine of one period, both linear.
HiddenEffect Periodic(const Scene&, const DetailOptions& detail, Dice* dice) {
  const LegPattern pattern = DrawLegPattern(0.0, 0.3, dice);
  const int size = static_cast<int>(pattern.parameters.size());
  const double period = dice->LogUniform(1e-3, 8e-3);
  const double second = detail.second_harmonic;
  HiddenEffect effect = OfLegs("leg_periodic", "leg_length", pattern, 3e-4, nullptr);
  effect.fixed = {{"period", period}, {"second_harmonic", second}};
  effect.largest = Eigen::VectorXd::Constant(2 * size, 3e-4);
  effect.parameters.resize(2 * size);
  for (int k = 0; k < size; ++k) {
    const double amplitude = dice->Uniform(0.5, 1.0), phase = dice->Uniform(0, 2 * M_PI);
    effect.parameters[k] = amplitude * std::cos(phase);
    effect.parameters[size + k] = amplitude * std::sin(phase);
  }
  effect.add =
      [spread = pattern.spread, size, period, second](
          const Scene&, const Row& row, const Eigen::VectorXd& parameters, Additions* additions) {
        const Six s = spread * parameters.head(size), c = spread * parameters.tail(size);
        for (int i = 0; i < 6; ++i) {
          const double turn = 2 * M_PI * row.lengths[i] / period;
          additions->leg[i] += s[i] * (std::sin(turn) + second * std::sin(2 * turn)) +
                               c[i] * (std::cos(turn) + second * std::cos(2 * turn));
        }
      };
  return effect;
}

HiddenEffect ScrewRotation(const Scene&, const DetailOptions&, Dice* dice) {
  LegPattern pattern = Common(0.0, dice);
  pattern.parameters *= dice->Sign();
  return OfLegs(
      "leg_screw_rotation", "roll", pattern, 1.6e-3, [](const Scene& scene, const Row& row) {
        return ForkRoll(scene.hexapod, scene.home, row.base_from_platform);
      });
}

HiddenEffect Backlash(const Scene&, const DetailOptions& detail, Dice* dice) {
  LegPattern pattern = DrawLegPattern(0.4, 0.3, dice);
  if (pattern.carriers.empty()) pattern.parameters = pattern.parameters.cwiseAbs();
  return OfLegs("leg_backlash",
                "leg_direction",
                pattern,
                4e-4,
                [width = detail.backlash_width](const Scene&, const Row& row) {
                  Six half;
                  for (int i = 0; i < 6; ++i)
                    half[i] = 0.5 * (width > 0 ? std::tanh(row.last_move[i] / width)
                                               : (row.last_move[i] > 0) - (row.last_move[i] < 0));
                  return half;
                });
}

HiddenEffect Thermal(const Scene& scene, const DetailOptions& detail, Dice* dice) {
  // The legs follow the air with a first-order lag.
  std::map<std::string, double> warmth;
  double lagged = scene.rows.front().temperature, before = scene.FirstTime();
  const double constant = detail.thermal_lag * scene.TimeSpan();
  for (const Row& row : scene.rows) {
    const double kept = constant > 0 ? std::exp(-(row.time - before) / constant) : 0.0;
    lagged = kept * lagged + (1 - kept) * row.temperature;
    before = row.time;
    warmth[row.label] = lagged - scene.reference_temperature;
  }
  return OfLegs(
      "leg_thermal",
      "temperature",
      Common(detail.unequal_legs, dice),
      3e-4,
      [warmth](const Scene&, const Row& row) { return Six(warmth.at(row.label) * row.lengths); });
}

// Force in the legs of the load, and of the platform itself.
HiddenEffect Compliance(const Scene&, const DetailOptions& detail, Dice* dice) {
  const double platform_mass = dice->Uniform(0, 3);
  const double load_height = dice->Uniform(0, 0.08);
  HiddenEffect effect = OfLegs(
      "leg_compliance",
      "leg_force",
      Common(detail.unequal_legs, dice),
      5e-6,
      [platform_mass, load_height](const Scene& scene, const Row& row) {
        const Eigen::Vector3d centre =
            row.payload_centre +
            (scene.tells_payload_centre ? 0.0 : load_height) * Eigen::Vector3d::UnitZ();
        const auto forces = [&](double mass, const Eigen::Vector3d& at) {
          return LegForces(scene.hexapod, row.base_from_platform, mass, at, scene.gravity);
        };
        return Six(forces(row.payload, centre) + forces(platform_mass, Eigen::Vector3d::Zero()));
      });
  effect.fixed = {{"platform_mass", platform_mass}, {"load_height", load_height}};
  return effect;
}

HiddenEffect Clearance(const Scene&, const DetailOptions&, Dice* dice) {
  return OfLegs(
      "leg_clearance",
      "leg_force",
      Common(0.0, dice),
      6e-4,
      [](const Scene& scene, const Row& row) {
        const Six force = LegForces(
            scene.hexapod, row.base_from_platform, row.payload, row.payload_centre, scene.gravity);
        Six half;
        for (int i = 0; i < 6; ++i) half[i] = 0.5 * ((force[i] > 0) - (force[i] < 0));
        return half;
      });
}

HiddenEffect Settling(const Scene&, const DetailOptions&, Dice* dice) {
  return OfLegs("settling", "last_move", Common(0.0, dice), 0.05, [](const Scene&, const Row& row) {
    return Six(-row.last_move);
  });
}

}  // namespace

std::vector<EffectRow> LegEffects() {
  return {{"leg_offset", Offset},
          {"leg_gain", Gain},
          {"leg_nonlinearity", Nonlinearity},
          {"leg_periodic", Periodic},
          {"leg_screw_rotation", ScrewRotation},
          {"leg_backlash", Backlash},
          {"leg_thermal", Thermal},
          {"leg_compliance", Compliance},
          {"leg_clearance", Clearance},
          {"settling", Settling}};
}

}  // namespace hexcal::hidden
