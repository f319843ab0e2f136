// SPDX-License-Identifier: BSD-3-Clause
#include "apps/audit_repetition.h"

#include <fmt/format.h>
#include <gflags/gflags.h>

#include "apps/estimate_mounts.h"
#include "estimator/certificate.h"
#include "estimator/pose_repetition.h"
#include "report/fit_words.h"

namespace hexcal {

AuditRepetition::AuditRepetition(const Dataset& dataset,
                                 const Observations& observations,
                                 const CalibrateOptions& options,
                                 const ResultHeader& header,
                                 const Estimate& estimate)
    : dataset_(dataset),
      options_(options),
      header_(header),
      estimate_(estimate),
      used_(options.outliers == OutlierHandling::kReject ? Without(observations, estimate.outliers)
                                                         : observations) {}

PropagationCheck AuditRepetition::Run(const MonteCarloOptions& repeat) {
  const bool is_audits = header_.residual == "pose";
  RepeatedFit fit;
  RepeatedAs as = {estimate_, is_audits, SolverWords(header_)};
  if (is_audits) {
    fit = {options_, InitialOf(dataset_, options_)};
    fit.keeps_draws = !gflags::GetCommandLineFlagInfoOrDie("draws").is_default;
    if (options_.loss.kind != LossKind::kNone)
      as.words += fmt::format(
          ", under the loss {} of scale {:.4g}", NameOf(options_.loss.kind), options_.loss.scale);
  } else {
    CalibrateOptions by_poses = options_;
    by_poses.start.reset();
    by_poses.outliers = OutlierHandling::kNotSought;
    as.estimate = Calibrate(used_, {}, by_poses);
    as.words = "the nonlinear fit by poses, in place of that by the readings of all markers";
  }
  const FitPropagation propagation = CheckFitPropagation(
      used_, LevelsOf(used_, options_.noise, as.estimate), as.estimate, fit, repeat);
  as.estimate.covariance_unscaled = propagation.first_order;
  repeated_ = std::move(as);
  return propagation.check;
}

}  // namespace hexcal
