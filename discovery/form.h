// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/effect.h"

namespace hexcal {

// One form that an effect may take: which of its parameters move together, and where the searched
// ones stand. To first order its corrections are linear in the coefficients, one a column.
struct FormDefinition {
  // How coefficients become the effect's parameters.
  enum class Reading {
    kLinear,      // parameters = those of `effect` + directions * coefficients
    kPeriodic,    // pairs of sine and cosine of the legs in index, to amplitude and phase
    kCompliance,  // [c, c/D mass, c/D height] with D the prior size of c
  };

  int family = 0;
  Effect effect;               // where derivatives are taken: zero but for what is searched
  Eigen::MatrixXd directions;  // kLinear: parameters x columns
  Reading reading = Reading::kLinear;
  Eigen::VectorXd scale;  // prior 1-sigma of each coefficient
  double log_prior = 0.0;
  // Columns that this form shares: those of another form (an index into the list), from this
  // column on. -1: its own.
  int shares = -1, shares_from = 0;

  int size() const { return static_cast<int>(scale.size()); }
};

// The effect that these coefficients are.
Effect EffectOf(const FormDefinition& form, const Eigen::VectorXd& coefficients);

}  // namespace hexcal
