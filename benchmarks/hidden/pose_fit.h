// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hidden/noise.h"

namespace hexcal::hidden {

// The generator's own calibration: base, tool and the tracker's pose in every row (one for all rows
// where it stands still) to the readings by Gauss-Newton with differences, from the truth.
struct Fit {
  Scene scene;                        // with the mounts and the tracker's poses that were found
  std::vector<HiddenEffect> effects;  // those fitted, with the parameters that were found
  double chi_square = 0.0;            // by the markers
  double pose_chi_square = 0.0;       // without the misfit of the markers within their bodies
  int poses = 0;
  Eigen::MatrixXd covariance;  // of base and tool, then the effects' parameters
};

// effects: those whose parameters are refitted, each under a prior of its plausible size.
Fit FitMounts(const Scene& scene,
              const std::vector<HiddenEffect>& effects,
              const std::vector<Reading>& readings);

// What is looked at: every marker, or the pose that each row's markers give.
enum class Level { kMarkers, kPoses };

// Clearness of some effects: what their readings differ from those without them after base, tool
// and the tracker's pose of each row have taken what they can, in sigmas of the true noise: the
// root of lambda. others: effects that are there in both.
double Snr(const Scene& scene,
           const std::vector<HiddenEffect>& effects,
           const std::vector<HiddenEffect>& others,
           Regime regime,
           Level level = Level::kMarkers);

// Scales the parameters until Snr is this. False: not with plausible parameters.
bool ScaleTo(double snr, const Scene& scene, Regime regime, Level level, HiddenEffect* effect);

// Root mean square distance of the tool's positions in the rows that are held out, m: what a fit
// predicts against the truth.
double HeldoutRms(const Fit& fit, const Scene& scene, const std::vector<HiddenEffect>& truth);
// What the noise of the 12 parameters alone leaves there.
double NoiseFloor(const Scene& scene);

}  // namespace hexcal::hidden
