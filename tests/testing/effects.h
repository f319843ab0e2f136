// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "model/data_fault.h"
#include "model/effect.h"
#include "testing/random.h"

namespace hexcal::testing {

// Legs or markers that carry an effect of this kind in a test: of markers 2 and 5.
inline std::vector<int> SomeIndex(const EffectKind& kind) {
  if (kind.site == "marker") return {2, 5};
  return {};
}

// An effect of the kind, of about `scales` times the plausible size; what is searched for in the
// middle of what a test's visits see.
template <typename Rng>
Effect SomeEffect(Rng& rng,
                  const EffectKind& kind,
                  const std::vector<Visit>& visits,
                  const Dataset& dataset,
                  double scales) {
  Effect effect;
  effect.name = std::string(kind.name);
  effect.index = SomeIndex(kind);
  effect.parameters.resize(kind.SizeFor(effect.index));
  const double middle = visits[visits.size() / 2].time;
  for (int k = 0; k < effect.parameters.size(); ++k) {
    const ParameterKind& parameter = kind.ParameterOf(k);
    if (!parameter.is_search)
      effect.parameters[k] = scales * kind.ScaleOf(k) * Uniform(rng, 0.5, 1.5);
    else if (parameter.name == "period")
      effect.parameters[k] = 0.005;
    else if (parameter.name == "time_constant")
      effect.parameters[k] = kind.name == "tracker_warmup" ? 0.5 * middle : middle;
    else
      effect.parameters[k] = middle;  // the time of a step
  }
  effect.reference = ReferenceFor(kind, visits, dataset);
  return effect;
}

}  // namespace hexcal::testing
