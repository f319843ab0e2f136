// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/model_forms.h"

#include <cmath>
#include <map>

#include "estimator/free_effect.h"

namespace hexcal {
namespace {

constexpr double kPriorWidth = 3.0;  // in plausible sizes, as calibrate --model has it

FormDefinition UnitForm(const Effect& effect, const std::vector<int>& numbers) {
  FormDefinition form;
  form.effect = effect;
  const auto count = static_cast<Eigen::Index>(numbers.size());
  form.directions.setZero(effect.parameters.size(), count);
  form.scale.setOnes(count);
  for (Eigen::Index k = 0; k < count; ++k) form.directions(numbers[k], k) = 1.0;
  return form;
}

bool IsLinear(const EffectKind* kind, int number) {
  if (kind == nullptr) return true;  // a description is a sum of columns
  const ParameterKind& parameter = kind->ParameterOf(number);
  return !parameter.is_search && parameter.acts_alone;
}

}  // namespace

EffectSignal SignalOf(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  std::vector<int> numbers;
  for (int n = 0; n < effect.parameters.size(); ++n)
    if (effect.parameters[n] != 0.0 && IsLinear(kind, n)) numbers.push_back(n);
  EffectSignal signal;
  signal.values.resize(static_cast<Eigen::Index>(numbers.size()));
  Effect at = effect;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    signal.values[static_cast<Eigen::Index>(k)] = effect.parameters[numbers[k]];
    at.parameters[numbers[k]] = 0.0;
  }
  signal.form = UnitForm(at, numbers);
  return signal;
}

FormDefinition FreeFormOf(const Effect& effect) {
  const GrownEffect grown = FreeEffect(effect, kPriorWidth);
  FormDefinition form = UnitForm(effect, grown.free);
  for (Eigen::Index k = 0; k < form.scale.size(); ++k)
    form.scale[k] = std::isfinite(grown.prior_sigma[k]) ? grown.prior_sigma[k] : 0.0;
  return form;
}

FormLibrary SomeForms(const FormLibrary& library,
                      const std::vector<int>& forms,
                      std::vector<int>* places) {
  FormLibrary some;
  some.families = library.families;
  std::map<int, int> placed;
  const auto place = [&](int form) {
    const auto [at, is_new] = placed.try_emplace(form, static_cast<int>(some.forms.size()));
    if (is_new) some.forms.push_back(library.forms[form]);
    return at->second;
  };
  for (const int form : forms) {
    const int shares = library.forms[form].shares;
    const int owner = shares < 0 ? -1 : place(shares);
    places->push_back(place(form));
    if (shares >= 0) some.forms[places->back()].shares = owner;
  }
  return some;
}

}  // namespace hexcal
