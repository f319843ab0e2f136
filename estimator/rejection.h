// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "estimator/estimate.h"
#include "estimator/outliers.h"

namespace hexcal {

enum class OutlierHandling {
  kNotSought,
  kKeep,    // listed, with a warning; the estimate stays that of all poses
  kReject,  // listed, and fitted without: their weight is 0, their residuals are in the result
};

// The estimate of fit, with outliers handled. Where there are none it is fit(observations) to the
// last bit. All but the residuals of the rejected are of the other poses. kKeep searches
// only where some residual is suspicious (MayHoldOutliers).
Estimate FitAroundOutliers(const Observations& observations,
                           const std::optional<NoiseLevels>& noise,
                           OutlierHandling handling,
                           const OutlierOptions& options,
                           const std::function<Estimate(const Observations&)>& fit);

// Whether a search could find any outlier beside this fit, told from its residuals in one cheap
// pass: false only where the largest, in sigmas by the median of all, is clearly below the limit.
bool MayHoldOutliers(const Observations& observations,
                     const std::optional<NoiseLevels>& noise,
                     const BaseAndTool& mounts,
                     const OutlierOptions& options);

}  // namespace hexcal
