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
  double scale = 0.0;      // 1-sigma that is physically plausible before the data are seen; 0:
                           // nothing is known
  bool is_search = false;  // the effect is not linear in it, so it must be searched for (a period,
                           // a time of a step, a time constant)
  double rotation_scale =
      0.0;                     // of a twist (size 6): of its last three numbers, scale of the first
  bool acts_alone = true;      // false: nothing where all others are zero (a phase, the mass of the
                               // platform), so no score can tell it
  bool is_per_marker = false;  // `size` numbers for each marker in the index, after all others
};

// A number, or several, that an effect refers to.
struct ReferenceKind {
  std::string_view name;
  std::string_view unit;
  int size = 1;
};

// Numbers that an effect's function refers to and that are not estimated: origin and span of the
// time, reference temperature, home lengths, the number of markers a body... By name.
using EffectReference = std::map<std::string, std::vector<double>>;

// One effect of a machine. parameters: all numbers of its kind's parameters, one after another;
// those of legs, joints or markers not in index are zero.
struct Effect {
  std::string name;  // of the table of kinds
  // Legs, joints or markers that carry it, from 1; markers: base body first. An effect of the legs
  // with one number for all acts on these legs, on all where the index is empty.
  std::vector<int> index;
  Eigen::VectorXd parameters;
  Eigen::VectorXd standard_deviation;  // NaN where not estimated; may be empty
  EffectReference reference;
  std::map<std::string, std::string> found;  // faults of the data: what was found, in words
};

// What an effect's function sees beside its parameters.
struct EffectInput {
  const Visit& visit;
  const std::vector<int>& index;
  const EffectReference& reference;
};

template <typename T>
using EffectFunction = void (*)(const EffectInput& input,
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
  std::vector<ReferenceKind> references = {};  // that apply asks for
  // ln of how often it is met against the others: it decides only where the data hardly do.
  double log_prior = 0.0;

  int size() const;  // of all parameters, with one marker
  int SizeFor(const std::vector<int>& index) const;
  int OffsetOf(std::string_view parameter) const;  // of its first number
  // Of one number of an effect's parameters.
  const ParameterKind& ParameterOf(int number) const;
  double ScaleOf(int number) const;
  std::string_view UnitOf(int number) const;
  bool IsFault() const { return apply == nullptr; }
};

// What was found but has no name: a correction by description, not by a function. In no table.
inline constexpr std::string_view kUnknownEffect = "unknown";

// All kinds, in the order of docs/effects.md.
const std::vector<EffectKind>& EffectKinds();
// Null where no kind has this name.
const EffectKind* FindEffectKind(std::string_view name);

// What the kind needs and the dataset lacks, in words ("a temperature column"), or empty.
std::string MissingFor(const EffectKind& kind, const Drivers& drivers);

// The references of an effect that is fitted to these visits: with them it says the same of any
// other rows.
EffectReference ReferenceFor(const EffectKind& kind,
                             const std::vector<Visit>& visits,
                             const Dataset& dataset);

// The sum over effects (faults of the data and the unknown add nothing). Other names, or another
// number of parameters than the kind's: CHECK.
Corrections<double> CorrectionsOf(const std::vector<Effect>& effects, const Visit& visit);
// d(corrections) / d(one parameter), exactly, at the effect's parameters.
Corrections<double> CorrectionsBy(const Effect& effect, int parameter, const Visit& visit);

}  // namespace hexcal
