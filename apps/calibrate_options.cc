// SPDX-License-Identifier: BSD-3-Clause
#include "apps/calibrate_options.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "apps/flags.h"
#include "apps/usage_error.h"

namespace hexcal {
namespace {

// The flag's choices (apps/flags.cc) have let nothing else through.
template <typename Value, std::size_t N>
Value FromName(const std::string& name,
               const std::array<std::pair<std::string_view, Value>, N>& names) {
  const auto found = std::find_if(
      names.begin(), names.end(), [&name](const auto& entry) { return entry.first == name; });
  CHECK(found != names.end()) << "no value for '" << name << "'";
  return found->second;
}

using Reading = LinearizedOptions::UnitMagnitude;

constexpr std::array<std::pair<std::string_view, Start>, 5> kStarts = {
    {{"closed_form", Start::kClosedForm},
     {"shah", Start::kShah},
     {"park_martin", Start::kParkMartin},
     {"initial", Start::kInitial},
     {"identity", Start::kIdentity}}};

constexpr std::array<std::pair<std::string_view, LossKind>, 4> kLosses = {
    {{"none", LossKind::kNone},
     {"huber", LossKind::kHuber},
     {"cauchy", LossKind::kCauchy},
     {"tukey", LossKind::kTukey}}};

constexpr std::array<std::pair<std::string_view, Reading>, 5> kReadings = {
    {{"approach_first", Reading::kApproachFirst},
     {"normal_first", Reading::kNormalFirst},
     {"nearest_rotation", Reading::kNearestRotation},
     {"columns", Reading::kColumns},
     {"rows", Reading::kRows}}};

// What only the nonlinear problem of poses has.
bool IsRobust(const CalibrateOptions& options) {
  return options.loss.kind != LossKind::kNone || options.covariance == CovarianceKind::kSandwich;
}

void RequireNonlinear(const CalibrateOptions& options) {
  if (FLAGS_loss_scale > 0 && options.loss.kind == LossKind::kNone)
    throw UsageError("--loss_scale needs a --loss other than none");
  if (options.solver == Solver::kLinearized && IsRobust(options))
    throw UsageError("--loss and --covariance=sandwich go with --solver=nonlinear only");
}

}  // namespace

CalibrateOptions CalibrateOptionsFromFlags() {
  CalibrateOptions options;
  options.solver = FLAGS_solver == "linearized" ? Solver::kLinearized : Solver::kNonlinear;
  if (!FLAGS_start.empty()) options.start = FromName(FLAGS_start, kStarts);
  if (FLAGS_noise_position > 0)
    options.noise = NoiseLevels{FLAGS_noise_position, FLAGS_noise_orientation};
  options.outliers = FLAGS_outliers == "reject" ? OutlierHandling::kReject : OutlierHandling::kKeep;
  options.evaluation =
      FLAGS_evaluation == "per_pose" ? Evaluation::kPerPose : Evaluation::kStreamed;
  options.loss = DefaultLoss(FromName(FLAGS_loss, kLosses));
  if (FLAGS_loss_scale > 0) options.loss.scale = FLAGS_loss_scale;
  if (FLAGS_covariance == "sandwich") options.covariance = CovarianceKind::kSandwich;
  RequireNonlinear(options);
  options.linearized.error =
      FLAGS_error == "twist" ? LinearizedOptions::Error::kTwist : LinearizedOptions::Error::kPaper;
  options.linearized.unit_magnitude = FromName(FLAGS_unit_magnitude, kReadings);
  options.linearized.max_iterations = FLAGS_iterations;
  options.linearized.tolerance = FLAGS_tolerance;
  return options;
}

bool IsByMarkers(const Dataset& dataset, const CalibrateOptions& options) {
  const bool has_markers = dataset.measurement->kind == Measurement::Kind::kMarkers;
  const bool is_linearized = options.solver == Solver::kLinearized;
  if (FLAGS_residual == "marker") {
    if (is_linearized) throw UsageError("--residual=marker goes with --solver=nonlinear only");
    if (IsRobust(options))
      throw UsageError("--loss and --covariance=sandwich go with --residual=pose only");
    if (!has_markers)
      throw UsageError(fmt::format(
          "--residual=marker: the measurement of {} is of kind poses, it has no markers",
          dataset.path));
    return true;
  }
  // Noise that is given is of poses.
  const bool has_use_for_noise = options.noise && !dataset.measurement->marker_sigma;
  return FLAGS_residual.empty() && has_markers && !is_linearized && !has_use_for_noise &&
         !IsRobust(options);
}

void RequireOptionsForEffects(const CalibrateOptions& options) {
  const bool is_plain = options.solver == Solver::kNonlinear && !IsRobust(options) &&
                        options.outliers == OutlierHandling::kKeep && FLAGS_residual != "marker";
  if (!is_plain)
    throw UsageError(
        "a --model with effects goes with --solver=nonlinear, --residual=pose, --loss=none, "
        "--covariance=model and --outliers=keep only");
}

ResultHeader HeaderOf(const std::string& dataset,
                      const CalibrateOptions& options,
                      bool by_markers) {
  const bool linearized = options.solver == Solver::kLinearized;
  const bool paper = options.linearized.error == LinearizedOptions::Error::kPaper;
  return {dataset,
          linearized ? "linearized" : "nonlinear",
          by_markers ? "marker" : "pose",
          !linearized ? ""
          : paper     ? "paper"
                      : "twist",
          {},
          options.loss,
          options.covariance == CovarianceKind::kSandwich};
}

}  // namespace hexcal
