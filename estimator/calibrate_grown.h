// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "estimator/calibrate.h"
#include "estimator/grown_solution.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

struct GrownCalibration {
  // As of a calibration by poses from which the effects are taken out; its mounts and covariance
  // are the joint fit's, which knows that the effects are uncertain too.
  Estimate estimate;
  Machine machine;  // the model with base, tool and effects as this dataset tells them
  std::shared_ptr<const GrownSolution> solution;  // refers to the dataset
};

// Base, tool and the effects of a model, on new data. Faults of the data are mended as the model
// says, its pose map and what has no name stay as they are; other effects are estimated under
// priors of three times their plausible size, or of the size in the model if that is more. Of the
// options: noise and threads. InputError where the dataset lacks what an effect needs.
GrownCalibration CalibrateGrown(const Dataset& dataset,
                                const Machine& model,
                                const CalibrateOptions& options);

}  // namespace hexcal
