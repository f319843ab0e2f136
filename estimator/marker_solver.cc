// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/marker_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/marker_reference.h"
#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

constexpr int kMaxRounds = 100;
// A sigma that changes by less than this part no longer moves the mounts.
constexpr double kSettled = 1e-9;
// The readings' rounding moves sigma by so many roundings.
constexpr double kRoundings = 64.0;
// After many rounds, a change below this that no longer shrinks is rounding, too.
constexpr int kManyRounds = 30;
constexpr double kStalled = 1e-3;
// The factor falls at least so fast with sigma, or the secant is not to be trusted.
constexpr double kSmallestSlope = -0.02;

class Solver {
 public:
  Solver(const MarkerObservations& markers,
         const BaseAndTool& start,
         const MarkerSolverOptions& options)
      : markers_(markers), options_(options), smallest_(SmallestSigma(markers)) {
    result_.blocks = MarkerLayout(markers.data)
                         .Start(markers.data, start.world_from_base, start.platform_from_tool);
  }

  MarkerSolution Run() {
    if (markers_.sigma) {
      result_.sigma = *markers_.sigma;
      result_.solution = Solve();
      return std::move(result_);
    }
    result_.sigma_estimated = true;
    const std::optional<Eigen::Vector3d> repeats = markers_.pure_error.Sigma();
    result_.sigma = repeats.value_or(Eigen::Vector3d::Ones());
    result_.sigma *= Factor();
    SolveInTurn();
    if (repeats) result_.over_repeats = result_.sigma.norm() / repeats->norm();
    return std::move(result_);
  }

 private:
  MarkerBatch Batch() const { return {markers_.data, result_.sigma, options_.threads}; }

  Solution Solve() {
    return options_.by_reference ? SolveByReference()
                                 : SolveStreamed(Batch(), options_.nonlinear, &result_.blocks);
  }

  Solution SolveByReference() {
    Solution solution;
    solution.iterations.push_back(Record());
    if (options_.nonlinear.max_iterations > 0) {
      MarkerReference reference =
          SolveMarkerReference(markers_.data, result_.sigma, result_.blocks);
      solution.converged = reference.converged;
      solution.message = reference.message;
      result_.blocks = std::move(reference.parameters);
      solution.iterations.push_back(Record());
    }
    solution.mounts = MountsOf(result_.blocks);
    return solution;
  }

  IterationRecord Record() const {
    const NormalEquations e = Evaluate(Batch(), result_.blocks);
    const double n = static_cast<double>(e.poses);
    return {0.5 * e.squared_norm,
            std::sqrt(e.position_squares / n),
            std::sqrt(e.orientation_squares / n)};
  }

  // Never below rounding.
  double Factor() const {
    const MarkerBatch batch = Batch();
    const MarkerFit fit = FitOf(batch, result_.blocks, Evaluate(batch, result_.blocks));
    return std::max(RemlFactor(markers_, fit), smallest_ / result_.sigma.minCoeff());
  }

  // Without robot noise the mounts do not depend on the level, and the second round only says so.
  void SolveInTurn() {
    double last_log_factor = 0.0, last_step = 0.0;
    for (int round = 0; round < kMaxRounds; ++round) {
      Append(Solve());
      if (!result_.solution.converged) return;
      const double log_factor = std::log(Factor());
      const double step = std::max(Step(log_factor, last_log_factor, last_step),
                                   std::log(smallest_ / result_.sigma.minCoeff()));
      result_.sigma *= std::exp(step);
      const double sigma = result_.sigma.minCoeff();
      const double settled = std::max(kSettled, kRoundings * smallest_ / sigma);
      const double change = std::abs(log_factor), last = std::abs(last_log_factor);
      const bool is_stalled = round > kManyRounds && change < kStalled && change > last;
      if (round > 0 && (change < settled || is_stalled)) return;
      last_log_factor = log_factor;
      last_step = step;
    }
    result_.solution.converged = false;
    result_.solution.message = "the markers' noise level did not settle";
  }

  // Of log(sigma), to where the factor is 1: by the secant through the last two, since with robot
  // noise the factor alone falls short of it.
  static double Step(double log_factor, double last_log_factor, double last_step) {
    const double slope = last_step != 0.0 ? (log_factor - last_log_factor) / last_step : -1.0;
    return std::clamp(slope < kSmallestSlope ? -log_factor / slope : log_factor, -2.0, 2.0);
  }

  // The records of a later round begin at the end of the one before.
  void Append(Solution next) {
    auto records = std::move(result_.solution.iterations);
    const std::ptrdiff_t skip = records.empty() ? 0 : 1;
    records.insert(records.end(), next.iterations.begin() + skip, next.iterations.end());
    next.iterations = std::move(records);
    result_.solution = std::move(next);
  }

  const MarkerObservations& markers_;
  const MarkerSolverOptions& options_;
  const double smallest_;
  MarkerSolution result_;
};

}  // namespace

MarkerFit FitOf(const MarkerBatch& batch,
                const ParameterBlocks& blocks,
                const NormalEquations& equations) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& block : blocks) pointers.push_back(block.data());
  return batch.FitAt(pointers.data(), InverseOfNormal(equations.normal));
}

double RemlFactor(const MarkerObservations& markers, const MarkerFit& fit) {
  const double freedom = markers.NumResiduals() - markers.NumParameters() - fit.draw_freedom;
  return freedom > 0.0 ? std::sqrt(fit.squared_readings / freedom) : 1.0;
}

double SmallestSigma(const MarkerObservations& markers) {
  double size = 0.0;
  for (const MarkerMean& reading : markers.data.readings)
    size = std::max(size, reading.p_in_tracker.norm());
  for (const MarkerPose& pose : markers.data.poses)
    size = std::max(size, pose.base_from_platform.translation.norm());
  return std::numeric_limits<double>::epsilon() * (size > 0 ? size : 1.0);
}

MarkerSolution SolveMarkers(const MarkerObservations& markers,
                            const BaseAndTool& start,
                            const MarkerSolverOptions& options) {
  return Solver(markers, start, options).Run();
}

}  // namespace hexcal
