// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect_terms.h"

namespace hexcal {

const std::vector<EffectKind>& EffectKinds() {
  static const std::vector<EffectKind> kinds = [] {
    std::vector<EffectKind> all;
    for (const auto& group : {LegEffects(),
                              ForceEffects(),
                              JointEffects(),
                              MountEffects(),
                              TrackerEffects(),
                              MarkerEffects(),
                              DataFaults()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return kinds;
}

const EffectKind* FindEffectKind(std::string_view name) {
  for (const EffectKind& kind : EffectKinds())
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace hexcal
