// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_repetition.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "estimator/normal_matrix.h"
#include "estimator/pose_fit.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "residuals/pose_stream.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 30;
// Squared length of a step in standard deviations after which nothing is left to do.
constexpr double kArrived = 1e-8;
// Probabilities at whose middles the loss is looked at.
constexpr int kQuantiles = 4000;
// Fits that go through all of a calibration, or under a loss, take as much longer.
constexpr int kFasterLeastSquares = 5;
constexpr int kFewestDraws = 500;
constexpr int kMostRounds = 2;

BaseAndTool Moved(const BaseAndTool& mounts, const Vector12d& step) {
  return {Plus(mounts.world_from_base, Vector6d(step.head<6>())),
          Plus(mounts.platform_from_tool, Vector6d(step.tail<6>()))};
}

bool IsPaper(const CalibrateOptions& options) {
  return options.solver == Solver::kLinearized &&
         options.linearized.error == LinearizedOptions::Error::kPaper;
}

}  // namespace

double VarianceUnderLoss(const RobustLoss& loss) {
  if (loss.kind == LossKind::kNone) return 1.0;
  double squares = 0.0, slopes = 0.0;
  for (int k = 0; k < kQuantiles; ++k) {
    const double s = ChiSquareQuantile((k + 0.5) / kQuantiles, 6.0);
    double rho, weight;
    loss.Evaluate(s, &rho, &weight);
    squares += weight * weight * s / 6.0;
    slopes += weight + s * loss.Curvature(s) / 3.0;
  }
  return kQuantiles * squares / (slopes * slopes);
}

PoseRepetition::PoseRepetition(const Observations& observations,
                               const NoiseLevels& levels,
                               const Estimate& estimate,
                               const RepeatedFit& fit)
    : observations_(observations),
      levels_(levels),
      mounts_(estimate.mounts),
      fit_(fit),
      weights_(PoseWeights::PerPose(observations.items.size())) {
  const std::size_t n = observations.items.size();
  covariances_.reserve(n), roots_.reserve(n), gains_.reserve(n);
  for (const Observation& o : observations.items) {
    covariances_.push_back(ErrorCovariance(o, observations, mounts_.platform_from_tool, levels));
    roots_.push_back(covariances_.back().llt().matrixL());
    weights_.Add(covariances_.back());
  }
  if (IsPaper(fit.options))
    AddPaper();
  else
    AddLeastSquares();
  AddCommon();
  sigma_ = first_order_.diagonal().cwiseSqrt();
}

// At a perfect fit the error's derivative is -PaperJacobian, so that the linear estimator moves by
// N^-1 J' C^-1 e, e = root z. Under a loss the same, as much longer as its variance is larger.
void PoseRepetition::AddLeastSquares() {
  Matrix12d normal = Matrix12d::Zero();
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    const Matrix6x12d whitened = roots_[i].triangularView<Eigen::Lower>().solve(
        PaperJacobian(observations_.items[i].base_from_platform * mounts_.platform_from_tool));
    normal += whitened.transpose() * whitened;
    gains_.push_back(whitened.transpose());
  }
  const double variance = VarianceUnderLoss(fit_.options.loss);
  const Matrix12d inverse = InverseOfNormal(normal);
  for (Gain& gain : gains_) gain = std::sqrt(variance) * inverse * gain;
  first_order_ = variance * inverse;
}

// The paper's iteration stands still where sum J' S e = 0 (estimator/judge.cc).
void PoseRepetition::AddPaper() {
  Matrix12d normal = Matrix12d::Zero();
  Vector12d squared_norms = Vector12d::Zero();
  for (std::size_t i = 0; i < roots_.size(); ++i) {
    const Pose3d base_from_tool =
        observations_.items[i].base_from_platform * mounts_.platform_from_tool;
    const Matrix6x12d j = PaperJacobian(base_from_tool);
    const Matrix6x12d carried =
        PaperErrorDerivative(mounts_.world_from_base * base_from_tool).transpose() * j;
    normal += carried.transpose() * j;
    squared_norms += j.colwise().squaredNorm().transpose();
    gains_.push_back(carried.transpose() * roots_[i]);
  }
  const Matrix12d inverse = InverseOfNormal(normal, squared_norms.cwiseSqrt());
  for (Gain& gain : gains_) {
    gain = inverse * gain;
    first_order_ += gain * gain.transpose();
  }
}

// The error of a tracker that stood still, the same in all poses: of the base alone.
void PoseRepetition::AddCommon() {
  if (!observations_.tracker_from_world) return;
  const Matrix6d carry = InverseAdjoint(mounts_.world_from_base);
  const Matrix6d common = carry * observations_.tracker_from_world_covariance * carry.transpose();
  const Eigenvalues eigen = DecomposeSymmetric(common);
  const Eigen::VectorXd roots = eigen.values.cwiseMax(0.0).cwiseSqrt();
  root_of_common_ = eigen.vectors * roots.asDiagonal();
  first_order_.topLeftCorner<6, 6>() += common;
}

Repetition::Block PoseRepetition::Run(int draws, std::uint64_t seed, std::size_t number) const {
  Block block;
  block.estimator.resize(12, draws);
  block.linear.resize(12, draws);
  std::seed_seq words{seed & 0xffffffffU, seed >> 32, static_cast<std::uint64_t>(number)};
  std::mt19937_64 rng(words);
  std::normal_distribution<double> distribution;
  const auto normal = [&] { return distribution(rng); };
  std::vector<Observation> rows = observations_.items;
  for (int k = 0; k < draws; ++k) {
    const Vector12d linear = Draw(normal, &rows);
    BaseAndTool found = Moved(mounts_, linear);
    block.not_converged += !Solve(rows, &found);
    Vector6d z = Vector6d::Zero();
    if (observations_.tracker_from_world)
      for (double& value : z) value = normal();
    const Vector6d common = root_of_common_ * z;
    block.linear.col(k) = linear;
    block.linear.col(k).head<6>() += common;
    block.estimator.col(k) << Minus(Plus(found.world_from_base, common), mounts_.world_from_base),
        Minus(found.platform_from_tool, mounts_.platform_from_tool);
  }
  return block;
}

// What is measured in one repetition, and what the linear estimator makes of it.
template <typename Normal>
Vector12d PoseRepetition::Draw(const Normal& normal, std::vector<Observation>* rows) const {
  Vector12d linear = Vector12d::Zero();
  for (std::size_t i = 0; i < rows->size(); ++i) {
    Vector6d z;
    for (double& value : z) value = normal();
    Observation& row = (*rows)[i];
    row.world_from_tool =
        Plus(mounts_.world_from_base * row.base_from_platform * mounts_.platform_from_tool,
             Vector6d(roots_[i] * z));
    linear += gains_[i] * z;
  }
  return linear;
}

bool PoseRepetition::Solve(const std::vector<Observation>& rows, BaseAndTool* mounts) const {
  if (fit_.options.solver == Solver::kLinearized) return SolveAsCalibrate(rows, mounts);
  PoseBatch batch;
  batch.Reserve(rows.size());
  for (const Observation& o : rows) batch.Add(o.base_from_platform, o.world_from_tool);
  if (fit_.options.loss.kind == LossKind::kNone) return SolveLeastSquares(batch, mounts);
  PoseFitOptions options;
  options.nonlinear = fit_.options.nonlinear;
  options.loss = fit_.options.loss;
  const PoseFit fit = FitPoses(batch, &weights_, *mounts, options);
  *mounts = fit.solution.mounts;
  return fit.solution.converged;
}

// Gauss-Newton steps until they are nothing.
bool PoseRepetition::SolveLeastSquares(const PoseBatch& batch, BaseAndTool* mounts) const {
  const PoseStream stream(batch, weights_);
  for (int k = 0; k < kMaxSteps; ++k) {
    const NormalEquations equations = stream.At(*mounts);
    const Matrix12d normal = equations.normal;
    const Vector12d gradient = equations.gradient;
    const Vector12d step = -Eigen::LLT<Matrix12d>(normal).solve(gradient);
    const double size = -step.dot(gradient);
    if (!std::isfinite(size)) return false;
    *mounts = Moved(*mounts, step);
    if (size < kArrived) return true;
  }
  return false;
}

bool PoseRepetition::SolveAsCalibrate(const std::vector<Observation>& rows,
                                      BaseAndTool* mounts) const {
  Observations measured = observations_;
  measured.items = rows;
  measured.warnings.clear();
  CalibrateOptions options = fit_.options;
  options.outliers = OutlierHandling::kNotSought;
  options.threads = 1;
  options.noise.reset();
  if (!observations_.tool_noise_is_known) options.noise = levels_;
  const Estimate estimate = Calibrate(measured, fit_.initial, options);
  *mounts = estimate.mounts;
  return estimate.converged;
}

FitPropagation CheckFitPropagation(const Observations& observations,
                                   const NoiseLevels& levels,
                                   const Estimate& estimate,
                                   const RepeatedFit& fit,
                                   const MonteCarloOptions& options) {
  FitPropagation propagation;
  propagation.check.why_not = WhyNotRepeated(observations, estimate);
  if (!propagation.check.why_not.empty()) return propagation;
  const PoseRepetition repetition(observations, levels, estimate, fit);
  MonteCarloOptions own = options;
  if (fit.options.solver == Solver::kLinearized || fit.options.loss.kind != LossKind::kNone) {
    if (!fit.keeps_draws) own.draws = std::max(options.draws / kFasterLeastSquares, kFewestDraws);
    own.most_rounds = std::min(options.most_rounds, kMostRounds);
  }
  propagation.check = CheckRepetition(repetition, own);
  propagation.first_order = repetition.first_order();
  return propagation;
}

}  // namespace hexcal
