// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/gap_model.h"
#include "discovery/gap_noise.h"
#include "discovery/joint_fit.h"
#include "estimator/estimate.h"

namespace hexcal {

// The grown machine: base, tool and all parameters of the effects together, exactly (Gauss-Newton
// over the forward model), with priors on the effects.
struct Refit {
  Mounts mounts;
  std::vector<Effect> effects;  // with standard deviations
  Eigen::MatrixXd covariance;   // of the mounts' 12, then of the free parameters
  GapProblem problem;           // at the solution, with the effects' free parameters as forms
  bool converged = false;
  std::vector<IterationRecord> iterations;  // of what is left over, from the start on
};

// effects: where to start. Free are the parameters of the legs or markers that an effect's index
// names, and what was searched for but times of steps. noise: of the poses, held. prior_width: of
// the priors, in plausible sizes.
Refit RefitMachine(const GapData& data,
                   const Mounts& start,
                   const std::vector<Effect>& effects,
                   const GapNoise& noise,
                   double prior_width);

// The same in the frame that the tracker took for the world (common_world.h), from which a fit goes
// on.
Refit RefitAsSeen(const GapData& data,
                  const Mounts& start,
                  const std::vector<Effect>& effects,
                  const GapNoise& noise,
                  double prior_width);

// The effects' free parameters as forms, at their present values: a form an effect.
FormLibrary FreeForms(const std::vector<Effect>& effects);

}  // namespace hexcal
