// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/form.h"

#include <glog/logging.h>

#include <cmath>

namespace hexcal {
namespace {

Effect PeriodicOf(const FormDefinition& form, const Eigen::VectorXd& pairs) {
  Effect effect = form.effect;
  const EffectKind& kind = *FindEffectKind(effect.name);
  const int amplitude = kind.OffsetOf("amplitude"), phase = kind.OffsetOf("phase");
  // One pair for all legs, or a pair each.
  for (std::size_t i = 0; i < effect.index.size(); ++i) {
    const int leg = effect.index[i] - 1;
    const Eigen::Index at = pairs.size() == 2 ? 0 : 2 * static_cast<Eigen::Index>(i);
    effect.parameters[amplitude + leg] = std::hypot(pairs[at], pairs[at + 1]);
    effect.parameters[phase + leg] = std::atan2(pairs[at + 1], pairs[at]);
  }
  return effect;
}

Effect ComplianceOf(const FormDefinition& form, const Eigen::VectorXd& c) {
  Effect effect = form.effect;
  const EffectKind& kind = *FindEffectKind(effect.name);
  const int compliance = kind.OffsetOf("compliance");
  const double unit = kind.ScaleOf(compliance);
  effect.parameters[compliance] = c[0];
  if (c.size() < 3 || c[0] == 0.0) return effect;
  // A mass is not negative; what the noise says of it is not to be believed further.
  effect.parameters[kind.OffsetOf("platform_mass")] = std::max(0.0, c[1] * unit / c[0]);
  effect.parameters[kind.OffsetOf("load_height")] = c[2] * unit / c[0];
  return effect;
}

}  // namespace

Effect EffectOf(const FormDefinition& form, const Eigen::VectorXd& coefficients) {
  CHECK_EQ(coefficients.size(), form.size()) << form.effect.name;
  switch (form.reading) {
    case FormDefinition::Reading::kPeriodic:
      return PeriodicOf(form, coefficients);
    case FormDefinition::Reading::kCompliance:
      return ComplianceOf(form, coefficients);
    case FormDefinition::Reading::kLinear:
      break;
  }
  Effect effect = form.effect;
  effect.parameters += form.directions * coefficients;
  return effect;
}

}  // namespace hexcal
