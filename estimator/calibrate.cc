// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/closed_form.h"
#include "estimator/noise.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// Rounds of fit and noise estimate; each takes the change down by a factor of ten or more.
constexpr int kMaxRounds = 30;
constexpr double kRoundTolerance = 1e-11;
// Chi-square per degree of freedom, as a factor of sigma, at which a stated noise is doubted.
constexpr double kDoubtfulScale = 2.0;

class Calibration {
 public:
  Calibration(const Observations& observations,
              const std::optional<BaseAndTool>& initial,
              const CalibrateOptions& options)
      : observations_(observations), initial_(initial), options_(options) {
    equal_weights_ = options.solver == Solver::kLinearized &&
                     options.linearized.error == LinearizedOptions::Error::kPaper;
    estimate_noise_ = !observations.tool_noise_is_known && !options.noise;
    if (options.noise) levels_ = *options.noise;
  }

  Estimate Run() {
    estimate_.warnings = observations_.warnings;
    estimate_.mounts = FirstGuess();
    Fit();
    SetResiduals();
    SetCovariance();
    AddWarnings();
    return std::move(estimate_);
  }

 private:
  BaseAndTool FirstGuess() const {
    const bool linearized = options_.solver == Solver::kLinearized;
    const Start start = options_.start.value_or(!linearized ? Start::kClosedForm
                                                : initial_  ? Start::kInitial
                                                            : Start::kIdentity);
    switch (start) {
      case Start::kClosedForm:
        return BestClosedForm(observations_.items);
      case Start::kShah:
        return SolveClosedForm(ClosedForm::kShah, observations_.items);
      case Start::kParkMartin:
        return SolveClosedForm(ClosedForm::kParkMartin, observations_.items);
      case Start::kInitial:
        CHECK(initial_) << "no initial guess";
        return *initial_;
      case Start::kIdentity:
        break;
    }
    return {};
  }

  Matrix6d Covariance(const Observation& o) const {
    return ErrorCovariance(o, observations_, estimate_.mounts.platform_from_tool, levels_);
  }

  std::vector<Matrix6d> Whiteners() const {
    std::vector<Matrix6d> whiteners;
    whiteners.reserve(observations_.items.size());
    for (const Observation& o : observations_.items) whiteners.push_back(WhitenerOf(Covariance(o)));
    return whiteners;
  }

  void Fit() {
    if (equal_weights_) {
      Take(SolveLinearized(observations_.items, {}, estimate_.mounts, options_.linearized));
      if (estimate_noise_) levels_ = EstimateNoiseOfEqualWeights(observations_, estimate_.mounts);
    } else {
      FitWeighted();
    }
  }

  // Weights follow the noise and (through the robot's noise) the tool; both follow the fit: in
  // turn, until nothing moves.
  void FitWeighted() {
    const bool weights_move = estimate_noise_ || observations_.has_robot_noise;
    if (estimate_noise_) {
      if (options_.solver == Solver::kLinearized)
        Take(SolveLinearized(observations_.items, {}, estimate_.mounts, options_.linearized));
      levels_ = RoughNoise(observations_, estimate_.mounts);
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      const BaseAndTool before = estimate_.mounts;
      const NoiseLevels levels_before = levels_;
      Take(SolveOnce());
      if (!estimate_.converged || !weights_move) return;
      if (estimate_noise_) levels_ = EstimateNoise(observations_, estimate_.mounts, levels_);
      if (round > 0 && Change(before, levels_before) < kRoundTolerance) return;
    }
    estimate_.converged = false;
    estimate_.message = fmt::format("the noise levels did not settle within {} rounds", kMaxRounds);
  }

  Solution SolveOnce() const {
    if (options_.solver == Solver::kLinearized) {
      LinearizedOptions options = options_.linearized;
      const int used = std::max(0, static_cast<int>(estimate_.iterations.size()) - 1);
      options.max_iterations = std::max(0, options.max_iterations - used);
      return SolveLinearized(observations_.items, Whiteners(), estimate_.mounts, options);
    }
    return SolveNonlinear(observations_.items, Whiteners(), estimate_.mounts, options_.nonlinear);
  }

  // The records of a later round begin at the end of the one before.
  void Take(const Solution& solution) {
    estimate_.mounts = solution.mounts;
    estimate_.converged = solution.converged;
    estimate_.message = solution.message;
    const std::size_t skip = estimate_.iterations.empty() ? 0 : 1;
    estimate_.iterations.insert(
        estimate_.iterations.end(), solution.iterations.begin() + skip, solution.iterations.end());
  }

  double Change(const BaseAndTool& before, const NoiseLevels& levels) const {
    const auto moved = [](const Pose3d& a, const Pose3d& b) {
      return Minus(a, b).cwiseAbs().maxCoeff();
    };
    double change = std::max(moved(estimate_.mounts.world_from_base, before.world_from_base),
                             moved(estimate_.mounts.platform_from_tool, before.platform_from_tool));
    if (estimate_noise_)
      change = std::max({change,
                         std::abs(std::log(levels_.position / levels.position)) * 1e-2,
                         std::abs(std::log(levels_.orientation / levels.orientation)) * 1e-2});
    return change;
  }

  void SetResiduals() {
    const double n = static_cast<double>(observations_.items.size());
    Vector6d mean_variance = Vector6d::Zero();
    for (const Observation& o : observations_.items) {
      const Vector6d e = PoseError(estimate_.mounts, o.base_from_platform, o.world_from_tool);
      const Matrix6d c = Covariance(o);
      estimate_.poses.push_back({o.label, 1.0, e});
      estimate_.chi_square += (WhitenerOf(c) * e).squaredNorm();
      estimate_.rmspe += e.head<3>().squaredNorm() / n;
      estimate_.rmsoe += e.tail<3>().squaredNorm() / n;
      mean_variance += c.diagonal() / n;
    }
    estimate_.rmspe = std::sqrt(estimate_.rmspe);
    estimate_.rmsoe = std::sqrt(estimate_.rmsoe);
    if (equal_weights_) {  // Eq. (42) over the paper's own differences
      estimate_.rmspe = estimate_.iterations.back().rmspe;
      estimate_.rmsoe = estimate_.iterations.back().rmsoe;
    }
    estimate_.noise = {std::sqrt(mean_variance.head<3>().mean()),
                       std::sqrt(mean_variance.tail<3>().mean()),
                       estimate_noise_};
  }

  void SetCovariance() {
    JacobianFactor factor;
    Matrix12d spread = Matrix12d::Zero();
    for (const Observation& o : observations_.items) {
      const Pose3d base_from_tool = o.base_from_platform * estimate_.mounts.platform_from_tool;
      const Vector6d e = PoseError(estimate_.mounts, o.base_from_platform, o.world_from_tool);
      const Matrix6x12d jacobian = PoseErrorJacobian(e, base_from_tool);
      factor.Add(WhitenerOf(Covariance(o)) * jacobian);
      if (equal_weights_) {
        equal_factor_.Add(jacobian);
        spread += jacobian.transpose() * Covariance(o) * jacobian;
      }
    }
    const CovarianceOptions options = Limits();
    ParameterCovariance result = ComputeCovariance(factor.R(), options);
    estimate_.observability = result.observability;
    if (equal_weights_) {
      const Matrix12d inverse = ComputeCovariance(equal_factor_.R(), options).covariance;
      result.covariance = inverse * spread * inverse;
    }
    const int parameters = 12 - result.observability.null_directions;
    estimate_.degrees_of_freedom = 6 * static_cast<int>(observations_.items.size()) - parameters;
    estimate_.noise_scale = std::sqrt(estimate_.chi_square / estimate_.degrees_of_freedom);
    const double scale = estimate_noise_ ? estimate_.noise_scale * estimate_.noise_scale : 1.0;
    const Matrix12d common = CommonTrackerCovariance();
    estimate_.covariance_unscaled = result.covariance + common;
    estimate_.covariance = scale * result.covariance + common;
  }

  CovarianceOptions Limits() const {
    CovarianceOptions options;
    double size = 0.0, orientation = 0.0;
    for (const Observation& o : observations_.items) {
      size = std::max(
          {size,
           (o.world_from_tool.translation - observations_.items[0].world_from_tool.translation)
               .norm(),
           (o.base_from_platform * estimate_.mounts.platform_from_tool).translation.norm()});
      orientation += o.robot_covariance.diagonal().tail<3>().mean() / observations_.items.size();
    }
    options.largest_sigma_m = std::max(size, 1e-3);
    options.robot_orientation_noise_rad = std::sqrt(orientation);
    return options;
  }

  // An error of the common tracker pose moves world_from_base alone, by its own amount.
  Matrix12d CommonTrackerCovariance() const {
    Matrix12d common = Matrix12d::Zero();
    if (observations_.tracker_from_world) {
      const Matrix6d carry = InverseAdjoint(estimate_.mounts.world_from_base);
      common.topLeftCorner<6, 6>() =
          carry * observations_.tracker_from_world_covariance * carry.transpose();
    }
    return common;
  }

  void AddWarnings() {
    auto& warnings = estimate_.warnings;
    if (!estimate_.converged) warnings.push_back("no convergence: " + estimate_.message);
    for (const std::string& direction : estimate_.observability.weak_directions)
      warnings.push_back("the data do not determine " + direction);
    if (!estimate_noise_ && estimate_.noise_scale > kDoubtfulScale)
      warnings.push_back(fmt::format(
          "the residuals are {:.1f} times larger than the stated noise explains: the noise is "
          "larger, or the model misses something",
          estimate_.noise_scale));
    if (options_.noise && observations_.tool_noise_is_known)
      warnings.push_back("the dataset states its noise; the noise given beside it is not used");
  }

  const Observations& observations_;
  const std::optional<BaseAndTool>& initial_;
  const CalibrateOptions& options_;
  bool equal_weights_ = false;
  bool estimate_noise_ = false;
  NoiseLevels levels_;
  JacobianFactor equal_factor_;
  Estimate estimate_;
};

}  // namespace

Estimate Calibrate(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CalibrateOptions& options) {
  return Calibration(observations, initial, options).Run();
}

}  // namespace hexcal
