// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "estimator/covariance.h"
#include "estimator/observations.h"

namespace hexcal {

// What the benchmarks and studies measure: a hexapod of ordinary size under an optical tracker of
// the 0.1 mm class. Every number is the same in every run.

// Tracker's noise in frame T: 0.1 mm and 0.5 mrad; uneven: 1:1:3 of these.
Matrix6d IsotropicNoise();
Matrix6d UnevenNoise();

struct StudyScene {
  BaseAndTool truth;               // any rotation of base and tool
  std::vector<Observation> exact;  // poses within +-40 mm and +-0.3 rad an axis, no noise
  Matrix6d noise;
  Matrix12d bound;  // Cramer-Rao: the covariance that no unbiased estimator can beat
};
StudyScene MakeStudyScene(int poses, const Matrix6d& noise, std::uint64_t seed);

// The same poses as measured in draw number draw. noise_is_known: stated with the poses, else left
// to be estimated.
Observations Draw(const StudyScene& scene, std::uint64_t draw, bool noise_is_known = true);

// The 12 differences estimate [-] truth.
Vector12d Error(const BaseAndTool& estimate, const BaseAndTool& truth);

}  // namespace hexcal
