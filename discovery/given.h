// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/gap_model.h"
#include "discovery/gap_noise.h"
#include "discovery/given_state.h"
#include "discovery/refit.h"
#include "model/machine.h"

namespace hexcal {

// A model that discovery starts from.

// The dataset as the model sees it: its hexapod, markers under their own names.
Dataset AsSeenBy(const Machine& model, const Dataset& dataset);

// The effects that are fitted along, and the faults of the data, which stay as they are.
// InputError where the dataset lacks what an effect needs; the model has no pose map.
std::vector<Effect> FittedEffects(const Machine& model);
std::vector<Effect> FaultsOf(const Machine& model);
void RequireDriversOf(const Machine& model, const Dataset& dataset);

// Base, tool and given effects where the data have them, and the problem of what those leave. The
// effects' free numbers are among its nuisances, so that they move along with base and tool in all
// that asks it.
struct GivenFit {
  Mounts mounts;
  std::vector<Effect> effects;
  GapProblem problem;
};
// InputError where the effects put legs out of reach.
GivenFit FitGiven(const GapData& data,
                  const Mounts& start,
                  const std::vector<Effect>& effects,
                  const FormLibrary& library);

// The RMS of each effect's numbers in plausible sizes, of the largest of them.
double LargestSize(const std::vector<Effect>& effects);

// refit: its first effects are those given, in their order. alpha: of each test. Wald's tests by
// the joint covariance, to which the model's own standard deviations add.
std::vector<GivenJudgement> JudgeGiven(const Refit& refit,
                                       const std::vector<Effect>& given,
                                       double alpha);

}  // namespace hexcal
