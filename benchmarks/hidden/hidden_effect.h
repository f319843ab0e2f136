// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "hidden/scene.h"

namespace hexcal::hidden {

// What effects add in one row, each at its site.
struct Additions {
  Six leg = Six::Zero();             // to the length that the controller reports, m
  Joints base = Joints::Zero();      // to the joint centres, frame B, m
  Joints platform = Joints::Zero();  // frame A
  Six base_twist = Six::Zero();      // right of world_from_base, [m, rad]
  Six platform_twist = Six::Zero();  // right of base_from_platform
  Six tool_twist = Six::Zero();      // right of platform_from_tool
  Six tracker_twist = Six::Zero();   // by which the tracker stands off, in its own frame
  Markers base_markers = Markers::Zero(), tool_markers = Markers::Zero();  // in W and T, m
  // What the tracker misreads of a point, m in its frame: one function an effect.
  std::vector<std::function<Eigen::Vector3d(const Eigen::Vector3d&)>> misreadings;
};

// An effect hidden in a scene. It is linear in its parameters (a period, a time of a step are fixed
// when it is drawn), zero parameters mean that it is absent.
struct HiddenEffect {
  std::string name;                // of spec/effects, or what an unlisted effect is
  bool is_listed = true;           // else the right answer is `unknown`, or its site
  std::vector<std::string> right;  // the names that are right: its own, or those of its site
  std::vector<int> carriers;       // the legs, joints or markers that carry it, where not all do
  std::string driver;              // what it follows
  Eigen::VectorXd parameters;
  Eigen::VectorXd largest;  // what is still plausible of each
  std::map<std::string, double> fixed;
  std::function<void(const Scene&, const Row&, const Eigen::VectorXd& parameters, Additions*)> add;
};

// How far the physics goes beyond the names' own forms.
struct DetailOptions {
  double second_harmonic = 0.0;  // of leg_periodic, a share of the first
  double thermal_lag = 0.0;      // time constant of leg_thermal, a share of the session
  double unequal_legs = 0.0;  // 1-sigma by which legs share thermal growth and compliance unequally
  double backlash_width = 0.0;  // m of travel over which the play is taken up
};

// As much of each as real machines show.
inline DetailOptions Detailed() { return {0.25, 0.05, 0.2, 5e-4}; }

using DrawEffect = HiddenEffect (*)(const Scene&, const DetailOptions&, Dice*);

struct EffectRow {
  std::string name;
  DrawEffect draw;
};

// By site, in the order of docs; a drawn pattern has an arbitrary size.
std::vector<EffectRow> LegEffects();
std::vector<EffectRow> JointEffects();
std::vector<EffectRow> MountEffects();
std::vector<EffectRow> TrackerEffects();
// All of the above.
const std::vector<EffectRow>& ListedEffects();
// Effects outside the library.
const std::vector<EffectRow>& UnlistedEffects();

// What the scene must have for the effect to be testable in it.
SceneOptions SceneFor(const std::string& effect, SceneOptions options);

Additions Sum(const std::vector<HiddenEffect>& effects, const Scene& scene, const Row& row);

// Parameters of a pattern over the legs: all alike, each its own, or one leg alone.
struct LegPattern {
  Eigen::Matrix<double, 6, Eigen::Dynamic> spread;  // legs x parameters
  Eigen::VectorXd parameters;
  std::vector<int> carriers;
};
LegPattern DrawLegPattern(double share_common, double share_each, Dice* dice);

}  // namespace hexcal::hidden
