// SPDX-License-Identifier: BSD-3-Clause
#include <glog/logging.h>

#include <memory>

#include "estimator/calibrate.h"
#include "estimator/pose_fit.h"
#include "methods.h"

namespace hexcal {
namespace {

Calibration Calibrated(std::shared_ptr<const Observations> own, const Observations& observations) {
  return [own, &observations] {
    const Estimate estimate = Calibrate(observations, {}, {});
    CHECK(estimate.IsTrustworthy()) << estimate.message;
    return estimate.mounts;
  };
}

// The same poses, no two of which have the same covariance.
Observations Unequal(Observations observations) {
  double factor = 1.0;
  for (Observation& o : observations.items) o.tool_covariance *= (factor += 1e-9);
  return observations;
}

Calibration Packed(const Observations& observations, PoseWeights::Kind kind) {
  const auto batch = std::make_shared<PoseBatch>();
  batch->Reserve(observations.items.size());
  for (const Observation& o : observations.items)
    batch->Add(o.base_from_platform, o.world_from_tool);
  const auto weights =
      std::make_shared<PoseWeights>(kind == PoseWeights::Kind::kCommon
                                        ? PoseWeights::Common(observations.items[0].tool_covariance)
                                        : PoseWeights::PerPose(observations.items.size()));
  if (kind == PoseWeights::Kind::kPerPose)
    for (const Observation& o : observations.items) weights->Add(o.tool_covariance);
  return [batch, weights] {
    PoseFitOptions options;
    options.method = PoseFitOptions::Method::kMoments;
    const PoseFit fit = FitPoses(*batch, weights.get(), std::nullopt, options);
    CHECK(fit.solution.converged) << fit.solution.message;
    CHECK(CovarianceOf(fit).allFinite());
    return fit.solution.mounts;
  };
}

Method PackedMethod(const char* name, PoseWeights::Kind kind) {
  return {name, [kind](const Observations& observations, const BaseAndTool&) {
            return Packed(observations, kind);
          }};
}

}  // namespace

Method Hexcal() {
  return {"hexcal", [](const Observations& observations, const BaseAndTool&) {
            return Calibrated(nullptr, observations);
          }};
}

Method HexcalFull() {
  return {"hexcal, full weights", [](const Observations& observations, const BaseAndTool&) {
            const auto own = std::make_shared<const Observations>(Unequal(observations));
            return Calibrated(own, *own);
          }};
}

Method HexcalPacked() { return PackedMethod("hexcal, packed", PoseWeights::Kind::kCommon); }

Method HexcalPackedFull() {
  return PackedMethod("hexcal, packed, full weights", PoseWeights::Kind::kPerPose);
}

}  // namespace hexcal
