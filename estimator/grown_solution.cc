// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_solution.h"

#include <fmt/format.h>

namespace hexcal {
namespace {

// Of a kind that is estimated: a number that it is worth saying that it is held.
bool IsWhenItSteps(const Effect& effect, const EffectKind& kind, int number) {
  const ParameterKind& parameter = kind.ParameterOf(number);
  return parameter.is_search && parameter.name == "time" && effect.parameters.size() > 0;
}

}  // namespace

std::vector<std::string> GrownSolution::Held() const {
  std::vector<std::string> held;
  if (data.pose_map) held.emplace_back("the pose map");
  for (const Effect& effect : fit.effects) {
    const EffectKind* kind = FindEffectKind(effect.name);
    if (kind == nullptr) {
      held.push_back(fmt::format("the effect '{}'", effect.name));
      continue;
    }
    if (kind->IsFault()) continue;
    for (int number = 0; number < effect.parameters.size(); ++number)
      if (IsWhenItSteps(effect, *kind, number))
        held.push_back(fmt::format("the time of '{}'", effect.name));
  }
  return held;
}

std::vector<std::string> GrownSolution::NotDetermined() const {
  std::vector<std::string> lost;
  std::size_t at = 12;
  for (const GrownEffect& effect : effects)
    for (const int number : effect.free) {
      if (at < fit.determined.size() && !fit.determined[at])
        lost.push_back(fmt::format("number {} of the effect '{}' ({})",
                                   number + 1,
                                   effect.effect.name,
                                   FindEffectKind(effect.effect.name)->ParameterOf(number).name));
      ++at;
    }
  return lost;
}

}  // namespace hexcal
