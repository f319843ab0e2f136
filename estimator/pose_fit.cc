// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/moment_fit.h"
#include "estimator/normal_matrix.h"
#include "estimator/streamed_solver.h"
#include "estimator/tiny.h"
#include "residuals/pose_stream.h"

namespace hexcal {
namespace {

constexpr int kMaxRefinements = 30;
// Of a standard deviation, or of a level: nothing moves any more.
constexpr double kSettled = 1e-10;
// Changes below this that no longer shrink are rounding.
constexpr double kStalled = 1e-3;
constexpr double kRoundings = 64.0;
// Enough for a closed form from which the solver starts.
constexpr std::size_t kStartPoses = 256;
// Standard deviations, all 12 parameters together, by which a sample's solution is hardly off.
constexpr double kFarInSampleSigmas = 10.0;

// An even sample as plain rows, for what need not see all poses.
std::vector<Observation> Sample(const PoseBatch& batch) {
  const std::size_t count = std::min(batch.size(), kSampleSize);
  std::vector<Observation> rows(count);
  for (std::size_t k = 0; k < count; ++k)
    batch.Get(k * batch.size() / count, &rows[k].base_from_platform, &rows[k].world_from_tool);
  return rows;
}

PoseBatch Packed(const std::vector<Observation>& rows) {
  PoseBatch batch;
  batch.Reserve(rows.size());
  for (const Observation& o : rows) batch.Add(o.base_from_platform, o.world_from_tool);
  return batch;
}

class Fit {
 public:
  Fit(const PoseBatch& batch, const PoseWeights* weights, const PoseFitOptions& options)
      : batch_(batch), given_(weights), options_(options) {}

  PoseFit Run(const std::optional<BaseAndTool>& start) {
    const bool is_large = batch_.size() >= kSampleFrom;
    std::vector<Observation> sample;
    if (!start || !given_ || is_large) sample = Sample(batch_);
    if (!given_) {
      const NoiseLevels spread = Spread(sample), rounding = Rounding(sample);
      variances_ = Squared(spread), floor_ = Squared(rounding);
    }
    BaseAndTool mounts = start ? *start : FindStart(EvenSample(sample, kStartPoses));
    // A loss has a start that is better than what the sample would give without its levels.
    if (is_large && options_.loss.kind == LossKind::kNone) {
      const PoseFit coarse = FitPoses(Packed(sample), nullptr, mounts, options_);
      if (coarse.solution.converged) {
        is_near_ = true;
        mounts = coarse.solution.mounts;
        if (!given_) variances_ = coarse.variances->values;
      }
    }
    Solve(mounts);
    return std::move(fit_);
  }

 private:
  static Eigen::Vector2d Squared(const NoiseLevels& levels) {
    return {levels.position * levels.position, levels.orientation * levels.orientation};
  }

  PoseWeights Weights() const {
    return given_ ? *given_
                  : PoseWeights::Isotropic(std::sqrt(variances_[0]), std::sqrt(variances_[1]));
  }

  void Solve(const BaseAndTool& mounts) {
    const PoseWeights own = given_ ? PoseWeights() : Weights();
    const PoseStream stream(batch_, given_ ? *given_ : own, options_.loss, options_.threads);
    ParameterBlocks blocks = BlocksOf(mounts);
    if (!is_near_ || !SolveFromNear(stream, &blocks))
      fit_.solution = options_.method == PoseFitOptions::Method::kTiny
                          ? SolveTiny(stream, options_.nonlinear, &blocks, &fit_.equations)
                          : SolveStreamed(stream, options_.nonlinear, &blocks, &fit_.equations);
    if (fit_.solution.converged && !given_) Refine(stream, &blocks);
  }

  // From the solution of a sample, Gauss-Newton steps do the rest: false where the first one is
  // longer than the sample's own error explains.
  bool SolveFromNear(const PoseStream& stream, ParameterBlocks* blocks) {
    fit_.equations = Evaluate(stream, *blocks);
    const IterationRecord start = RecordOf(0.5 * fit_.equations.squared_norm, fit_.equations);
    const Eigen::VectorXd step = GaussNewtonStep(fit_.equations);
    const double length = std::sqrt(std::max(0.0, -step.dot(fit_.equations.gradient)));
    const double share = static_cast<double>(batch_.size()) / kSampleSize;
    if (!(length < kFarInSampleSigmas * std::sqrt(share))) return false;
    *blocks = Polished(stream, *blocks, &fit_.equations);
    fit_.solution.mounts = MountsOf(*blocks);
    fit_.solution.converged = true;
    fit_.solution.iterations = {start, RecordOf(0.5 * fit_.equations.squared_norm, fit_.equations)};
    return true;
  }

  // Levels and mounts in turn from the parts of one pass, until neither moves: what the levels do
  // to the sums needs no other pass.
  void Refine(const PoseStream& stream, ParameterBlocks* blocks) {
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMaxRefinements; ++k) {
      const Eigen::VectorXd before = variances_;
      fit_.variances = EstimateVariances(fit_.equations.components, variances_, floor_);
      variances_ = fit_.variances->values;
      SetVariances(variances_, &fit_.equations);
      const Eigen::VectorXd step = GaussNewtonStep(fit_.equations);
      const double length = std::sqrt(std::max(0.0, -step.dot(fit_.equations.gradient)));
      const double change = (variances_.array() / before.array() - 1.0).abs().maxCoeff();
      const double largest = std::max(length, change);
      // Rounding is all that is left.
      const bool is_small = largest < kStalled || step.cwiseAbs().maxCoeff() < Rounded();
      if (is_small && !(largest < 0.5 * last)) return;
      *blocks = Moved(*blocks, step);
      fit_.solution.mounts = MountsOf(*blocks);
      if (largest < kSettled) return;
      last = largest;
      fit_.equations = Evaluate(stream, *blocks);
      SetVariances(variances_, &fit_.equations);
      fit_.solution.iterations.push_back(
          RecordOf(0.5 * fit_.equations.squared_norm, fit_.equations));
    }
    fit_.solution.converged = false;
    fit_.solution.message =
        fmt::format("noise and solution did not settle within {} steps", kMaxRefinements);
  }

  // A step, m or rad, that the rounding of the data may make.
  double Rounded() const { return kRoundings * std::sqrt(floor_.maxCoeff()); }

  const PoseBatch& batch_;
  const PoseWeights* given_;
  const PoseFitOptions& options_;
  Eigen::VectorXd variances_, floor_;
  bool is_near_ = false;  // the solution of a sample is the start
  PoseFit fit_;
};

}  // namespace

PoseFit FitPoses(const PoseBatch& batch,
                 const PoseWeights* weights,
                 const std::optional<BaseAndTool>& start,
                 const PoseFitOptions& options) {
  const bool by_moments = options.method == PoseFitOptions::Method::kMoments && weights && !start &&
                          options.loss.kind == LossKind::kNone;
  if (by_moments)
    if (std::optional<MomentFit> fit = FitByMoments(batch, *weights, options.threads))
      return {std::move(fit->solution), std::move(fit->equations), std::nullopt};
  return Fit(batch, weights, options).Run(start);
}

Matrix12d CovarianceOf(const PoseFit& fit) { return InverseOfNormal(fit.equations.normal); }

}  // namespace hexcal
