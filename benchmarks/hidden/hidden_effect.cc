// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/hidden_effect.h"

#include <cmath>

namespace hexcal::hidden {

const std::vector<EffectRow>& ListedEffects() {
  static const std::vector<EffectRow> all = [] {
    std::vector<EffectRow> rows = LegEffects();
    for (const auto& more : {JointEffects(), MountEffects(), TrackerEffects()})
      rows.insert(rows.end(), more.begin(), more.end());
    return rows;
  }();
  return all;
}

SceneOptions SceneFor(const std::string& effect, SceneOptions options) {
  options.is_extreme |= effect == "leg_clearance";
  options.has_velocity |= effect == "latency";
  return options;
}

Additions Sum(const std::vector<HiddenEffect>& effects, const Scene& scene, const Row& row) {
  Additions additions;
  for (const HiddenEffect& effect : effects) effect.add(scene, row, effect.parameters, &additions);
  return additions;
}

LegPattern DrawLegPattern(double share_common, double share_each, Dice* dice) {
  LegPattern pattern;
  const double roll = dice->Uniform(0, 1);
  if (roll < share_common) {
    pattern.spread = Eigen::MatrixXd::Ones(6, 1);
  } else if (roll < share_common + share_each) {
    pattern.spread = Eigen::MatrixXd::Identity(6, 6);
  } else {
    pattern.carriers = {1 + dice->Below(6)};
    pattern.spread = Eigen::MatrixXd::Zero(6, 1);
    pattern.spread(pattern.carriers[0] - 1, 0) = 1.0;
  }
  const int size = static_cast<int>(pattern.spread.cols());
  pattern.parameters = size == 1 ? Eigen::VectorXd::Constant(1, dice->Sign()) : dice->Normals(size);
  return pattern;
}

}  // namespace hexcal::hidden
