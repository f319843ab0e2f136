// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/hidden_case.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hidden/pose_fit.h"

namespace hexcal::hidden {
namespace {

const EffectRow* Find(const std::string& name) {
  for (const auto* table : {&ListedEffects(), &UnlistedEffects()})
    for (const EffectRow& row : *table)
      if (row.name == name) return &row;
  return nullptr;
}

std::vector<std::string> DrawPair(Dice* dice) {
  const auto& all = ListedEffects();
  const int size = static_cast<int>(all.size());
  for (;;) {
    const std::string first = all[dice->Below(size)].name, second = all[dice->Below(size)].name;
    if (first != second && !AreAlike(first, second)) return {first, second};
  }
}

std::vector<std::string> NamesOf(const std::string& kind, std::uint64_t number, Dice* dice) {
  if (kind == "clean") return {};
  if (kind == "any") return {ListedEffects()[number % ListedEffects().size()].name};
  if (kind == "unlisted") return {UnlistedEffects()[number % UnlistedEffects().size()].name};
  if (kind == "pair") return DrawPair(dice);
  const auto plus = kind.find('+');
  if (plus == std::string::npos) return {kind};
  return {kind.substr(0, plus), kind.substr(plus + 1)};
}

// One try: false where an effect would have to be implausibly large.
bool TryEffects(const CaseOptions& options,
                const std::vector<std::string>& names,
                Case* made,
                Dice* dice) {
  made->effects.clear();
  for (const std::string& name : names) {
    HiddenEffect effect = DrawNamed(name, made->scene, options.detail, dice);
    if (!ScaleTo(options.snr, made->scene, options.regime, options.level, &effect)) return false;
    made->effects.push_back(effect);
  }
  return true;
}

}  // namespace

bool AreAlike(const std::string& a, const std::string& b) {
  static const std::set<std::string> geometry = {"leg_offset",
                                                 "leg_gain",
                                                 "base_joint_offset",
                                                 "platform_joint_offset",
                                                 "base_radius",
                                                 "platform_radius",
                                                 "joint_axis_offset",
                                                 "tracker_scale"};
  return geometry.count(a) > 0 && geometry.count(b) > 0;
}

HiddenEffect DrawNamed(const std::string& name,
                       const Scene& scene,
                       const DetailOptions& detail,
                       Dice* dice) {
  const EffectRow* row = Find(name);
  if (row == nullptr) throw std::runtime_error("no effect has the name " + name);
  return row->draw(scene, detail, dice);
}

Case MakeCase(const CaseOptions& options, std::uint64_t series, std::uint64_t number) {
  Dice dice(series, number);
  Case made;
  made.name = options.kind + "-" + std::to_string(number);
  std::replace(made.name.begin(), made.name.end(), '+', '-');
  const std::vector<std::string> names = NamesOf(options.kind, number, &dice);
  SceneOptions scene = options.scene;
  for (const std::string& name : names) scene = SceneFor(name, scene);
  for (int attempt = 0; attempt < 200; ++attempt) {
    // A warm-up of the whole tracker shows only where it stands still.
    if (std::count(names.begin(), names.end(), "tracker_warmup") > 0)
      scene.is_static = options.scene.is_static || dice.Chance(0.5);
    made.scene = DrawScene(scene, &dice);
    // A tracker of a few micrometres makes small effects clear.
    if (attempt > 20 && options.scene.sigma == 0) scene.sigma = dice.LogUniform(3e-6, 20e-6);
    if (!TryEffects(options, names, &made, &dice)) continue;
    made.readings = NoisyReadings(made.scene, made.effects, options.regime, &dice);
    return made;
  }
  throw std::runtime_error("no plausible " + options.kind + " of this clearness");
}

}  // namespace hexcal::hidden
