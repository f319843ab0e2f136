// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/corrections.h"
#include "model/dual.h"
#include "model/visit.h"

namespace hexcal {

// One parameter of a kind of effect: `size` numbers, one a leg, axis, coordinate...
struct ParameterKind {
  std::string_view name;
  std::string_view unit;
  int size = 1;
  double scale = 0.0;      // 1-sigma that is physically plausible before the data are seen
  bool is_search = false;  // the effect is not linear in it, so it must be searched for (a period,
                           // a time of a step, a time constant)
};

// Numbers that an effect's function refers to and that are not estimated: origin and span of the
// time, reference temperature, home lengths, the number of markers a body... By name.
using EffectReference = std::map<std::string, std::vector<double>>;

// One effect of a machine. parameters: all numbers of its kind's parameters, one after another;
// those of legs, joints or markers not in index are zero.
struct Effect {
  std::string name;  // of the table of kinds
  std::vector<int>
      index;  // legs, joints or markers that carry it, from 1; markers: base body first
  Eigen::VectorXd parameters;
  Eigen::VectorXd standard_deviation;  // NaN where not estimated; may be empty
  EffectReference reference;
  std::map<std::string, std::string> found;  // faults of the data: what was found, in words
};

template <typename T>
using EffectFunction = void (*)(const Visit& visit,
                                const EffectReference& reference,
                                const T* parameters,
                                Corrections<T>* corrections);

// A row of the table of effects (docs/effects.md): the only place that knows its name and size.
struct EffectKind {
  std::string_view name, site, driver, shape;
  std::string_view cause;  // one sentence
  std::vector<ParameterKind> parameters;
  std::vector<std::string_view> needs;  // legs, time, temperature, payload, gravity, order,
                                        // velocity, markers
  // Adds the effect's share at its site. Zero parameters (but those searched for) add nothing.
  // Null for faults of the data.
  EffectFunction<double> apply = nullptr;
  EffectFunction<Dual> apply_dual = nullptr;

  int size() const;                                // of all parameters
  int OffsetOf(std::string_view parameter) const;  // of its first number
  bool IsFault() const { return apply == nullptr; }
};

// All kinds, in the order of docs/effects.md.
const std::vector<EffectKind>& EffectKinds();
// Null where no kind has this name.
const EffectKind* FindEffectKind(std::string_view name);

// What the kind needs and the dataset lacks, in words ("a temperature column"), or empty.
std::string MissingFor(const EffectKind& kind, const Drivers& drivers);

// The references of an effect that is fitted to these visits.
EffectReference ReferenceFor(const EffectKind& kind,
                             const std::vector<Visit>& visits,
                             const Dataset& dataset);

// The sum over effects (faults of the data add nothing).
Corrections<double> CorrectionsOf(const std::vector<Effect>& effects, const Visit& visit);
// d(corrections) / d(one parameter), exactly, at the effect's parameters.
Corrections<double> CorrectionsBy(const Effect& effect, int parameter, const Visit& visit);

}  // namespace hexcal
