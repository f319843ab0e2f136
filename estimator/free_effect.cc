// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/free_effect.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hexcal {
namespace {

// A number of a parameter that has one for each leg (or three): whether the effect's legs have it.
bool IsCarried(const Effect& effect, const EffectKind& kind, int number) {
  const ParameterKind& parameter = kind.ParameterOf(number);
  const bool is_by_leg =
      kind.site == "leg" || kind.site == "base_joint" || kind.site == "platform_joint";
  if (!is_by_leg || parameter.size % kNumLegs != 0 || effect.index.empty()) return true;
  const int leg = (number - kind.OffsetOf(parameter.name)) / (parameter.size / kNumLegs) + 1;
  return std::count(effect.index.begin(), effect.index.end(), leg) > 0;
}

// What no derivative sees: when a step is; a time constant of 0, which means a straight line; the
// phase of a wave of height zero, and whether there is a second wave at all.
bool CanMove(const Effect& effect, const EffectKind& kind, int number) {
  const ParameterKind& parameter = kind.ParameterOf(number);
  if (parameter.is_search) return parameter.name != "time" && effect.parameters[number] != 0.0;
  if (kind.name != "leg_periodic" || parameter.name == "amplitude") return true;
  const bool is_second = parameter.name == "amplitude_2" || parameter.name == "phase_2";
  const int leg = number - kind.OffsetOf(parameter.name);
  return effect.parameters[kind.OffsetOf(is_second ? "amplitude_2" : "amplitude") + leg] != 0.0;
}

bool HasPrior(const ParameterKind& parameter, double scale) {
  const bool is_phase = parameter.unit == "rad" && !parameter.acts_alone;
  return scale > 0.0 && !parameter.is_search && !is_phase;
}

// RMS of the effect's numbers that have a prior, in plausible scales.
double SizeOf(const Effect& effect, const EffectKind& kind) {
  double sum = 0.0;
  int count = 0;
  for (int number = 0; number < effect.parameters.size(); ++number) {
    const double scale = kind.ScaleOf(number);
    if (!IsCarried(effect, kind, number) || !HasPrior(kind.ParameterOf(number), scale)) continue;
    const double size = effect.parameters[number] / scale;
    sum += size * size, ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

GrownEffect FreeEffect(const Effect& effect, double widths) {
  GrownEffect grown;
  grown.effect = effect;
  const EffectKind* kind = FindEffectKind(effect.name);
  if (kind == nullptr || kind->IsFault()) return grown;
  std::vector<double> mean, sigma;
  const double size = std::max(1.0, SizeOf(effect, *kind));
  for (int number = 0; number < effect.parameters.size(); ++number) {
    if (!IsCarried(effect, *kind, number) || !CanMove(effect, *kind, number)) continue;
    const double scale = kind->ScaleOf(number);
    const bool has_prior = HasPrior(kind->ParameterOf(number), scale);
    grown.free.push_back(number);
    mean.push_back(has_prior ? 0.0 : effect.parameters[number]);
    sigma.push_back(has_prior ? widths * size * scale : std::numeric_limits<double>::infinity());
  }
  const auto count = static_cast<Eigen::Index>(mean.size());
  grown.prior_mean = Eigen::Map<const Eigen::VectorXd>(mean.data(), count);
  grown.prior_sigma = Eigen::Map<const Eigen::VectorXd>(sigma.data(), count);
  return grown;
}

}  // namespace hexcal
