// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/gap_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kRemlIterations = 40;
constexpr double kRemlTolerance = 1e-4;
constexpr double kRank = 1e-7;
// 2 ln of the likelihood ratio from which tails count as heavy: one parameter on its boundary, at
// some 1 in 500.
constexpr double kHeavy = 8.0;
// Correlations below so many standard errors are taken for none.
constexpr double kClear = 3.5;
constexpr std::array<double, 8> kTails = {3, 4, 5, 7, 10, 15, 25, 50};

Matrix6d Covariance(const LinearProblem& problem, const std::vector<double>& factor, int pose) {
  Matrix6d sum = Matrix6d::Zero();
  for (std::size_t c = 0; c < factor.size(); ++c) sum += factor[c] * problem.components[c][pose];
  return sum;
}

// Whitened nuisances' orthonormal basis and the residual of the error.
struct Projection {
  Eigen::MatrixXd basis;
  Eigen::VectorXd residual;
};

Projection Project(const Eigen::MatrixXd& nuisance, const Eigen::VectorXd& error) {
  Projection p;
  p.basis = OrthonormalBasis(nuisance, kRank);
  p.residual = error - p.basis * (p.basis.transpose() * error);
  return p;
}

// One step of the fixed point that restricted likelihood has where each component's sum of squares
// meets its expectation: factor *= (r' C r) / tr(P C). Factors stay positive.
double RemlStep(const LinearProblem& problem, GapNoise* noise) {
  const Projection p = Project(WhitenPoseRows(problem, *noise, problem.nuisance),
                               WhitenPoseRows(problem, *noise, problem.error));
  const std::size_t count = noise->factor.size();
  std::vector<double> found(count, 0.0), expected(count, 0.0);
  for (int k = 0; k < problem.poses; ++k) {
    const Matrix6d root = noise->Root(problem, k);
    const auto lower = root.triangularView<Eigen::Lower>();
    const Vector6d r = p.residual.segment<6>(6 * k);
    const Eigen::MatrixXd q = p.basis.middleRows(6 * k, 6);
    for (std::size_t c = 0; c < count; ++c) {
      Matrix6d half = lower.solve(problem.components[c][k]);
      const Matrix6d whitened = lower.solve(half.transpose().eval()) / noise->weight[k];
      found[c] += r.dot(whitened * r);
      expected[c] += whitened.trace() - (q.transpose() * whitened * q).trace();
    }
  }
  double change = 0.0;
  for (std::size_t c = 0; c < count; ++c) {
    const double ratio = std::clamp(found[c] / expected[c], 1e-3, 1e3);
    // A component that hardly contributes is left to fade.
    const double share = noise->factor[c] * expected[c] / (6.0 * problem.poses);
    if (share > 1e-4) change = std::max(change, std::abs(ratio - 1.0));
    noise->factor[c] *= ratio;
  }
  return change;
}

double LeastFactor(const LinearProblem& problem, std::size_t component) {
  return component < problem.least_factor.size() ? problem.least_factor[component] : 0.0;
}

void FitFactors(const LinearProblem& problem, GapNoise* noise) {
  for (int i = 0; i < kRemlIterations; ++i)
    if (RemlStep(problem, noise) < kRemlTolerance) break;
  for (std::size_t c = 0; c < noise->factor.size(); ++c)
    noise->factor[c] = std::max(noise->factor[c], LeastFactor(problem, c));
}

// Squared whitened residual of each pose at weight one.
Eigen::VectorXd Distances(const LinearProblem& problem, const GapNoise& noise) {
  const Projection p = Project(WhitenPoseRows(problem, noise, problem.nuisance),
                               WhitenPoseRows(problem, noise, problem.error));
  Eigen::VectorXd d(problem.poses);
  for (int k = 0; k < problem.poses; ++k) {
    // What the fit took from this pose's six numbers is given back.
    const double left = 6.0 - p.basis.middleRows(6 * k, 6).squaredNorm();
    d[k] = p.residual.segment<6>(6 * k).squaredNorm() / noise.weight[k] * 6.0 / std::max(left, 1.0);
  }
  return d;
}

// ln density of six-dimensional Student's t with unit covariance (not unit scale).
double LogStudent(double squared, double freedom, double dimension) {
  const double scaled = squared * freedom / (freedom - 2.0);
  return std::lgamma(0.5 * (freedom + dimension)) - std::lgamma(0.5 * freedom) -
         0.5 * dimension * std::log(freedom - 2.0) -
         0.5 * (freedom + dimension) * std::log1p(scaled / freedom);
}
double LogGauss(double squared, double dimension) {
  return -0.5 * squared - 0.5 * dimension * std::log(2.0);
}

// The heaviest tails that the squared distances ask for; 0: Gaussian. Distances are taken in units
// of their own mean.
double TailFreedom(const Eigen::VectorXd& squared, double dimension) {
  const double unit = squared.mean() / dimension;
  double gauss = 0.0;
  for (const double d : squared) gauss += LogGauss(d / unit, dimension);
  double best = gauss, freedom = 0.0;
  for (const double tail : kTails) {
    // The scale has its own maximum for each tail: a few steps of its fixed point.
    double scale = unit;
    for (int i = 0; i < 20; ++i) {
      double sum = 0.0;
      for (const double d : squared)
        sum += (tail + dimension) / (tail - 2.0 + d / scale) * d / dimension;
      scale = sum / static_cast<double>(squared.size());
    }
    double sum = 0.0;
    for (const double d : squared)
      sum += LogStudent(d / scale, tail, dimension) - 0.5 * dimension * std::log(scale / unit);
    if (sum > best) best = sum, freedom = tail;
  }
  return 2.0 * (best - gauss) > kHeavy ? freedom : 0.0;
}

// Weights of Student's t whose scale is that of the weighted poses themselves.
Eigen::VectorXd Weights(const Eigen::VectorXd& squared, double freedom, double dimension) {
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(squared.size());
  double scale = squared.mean() / dimension;
  for (int i = 0; i < 30; ++i) {
    weight = ((freedom + dimension) / (freedom + squared.array() / scale)).matrix();
    scale = weight.dot(squared) / (dimension * static_cast<double>(squared.size()));
  }
  return weight;
}

void FitTails(const LinearProblem& problem, GapNoise* noise) {
  noise->tail_freedom = TailFreedom(Distances(problem, *noise), 6.0);
  if (noise->tail_freedom == 0.0) return;
  for (int i = 0; i < 4; ++i) {
    noise->weight = Weights(Distances(problem, *noise), noise->tail_freedom, 6.0);
    FitFactors(problem, noise);
  }
}

// A mean and a slope taken out of a series of n make it look less correlated than it is.
double Taken(double correlation, int n) { return (2.0 + 4.0 * std::max(correlation, 0.0)) / n; }

void FitCorrelation(const LinearProblem& problem, const Eigen::MatrixXd& trend, GapNoise* noise) {
  Eigen::MatrixXd all(problem.error.size(), problem.nuisance.cols() + trend.cols());
  all << problem.nuisance, trend;
  const Projection p =
      Project(WhitenPoseRows(problem, *noise, all), WhitenPoseRows(problem, *noise, problem.error));
  double product = 0.0, square = 0.0;
  for (int k = 1; k < problem.poses; ++k)
    product += p.residual.segment<6>(6 * k).dot(p.residual.segment<6>(6 * (k - 1)));
  square = p.residual.squaredNorm();
  const double rows = static_cast<double>(p.residual.size()), raw = product / square;
  const double found = raw + Taken(raw, problem.poses);
  if (found > kClear / std::sqrt(rows)) noise->correlation = std::min(found, 0.97);
}

// Rows of each pose: where they start.
std::vector<Eigen::Index> ShapeStarts(const LinearProblem& problem) {
  std::vector<Eigen::Index> starts = {0};
  for (const int rows : problem.shape_freedom) starts.push_back(starts.back() + rows);
  return starts;
}

// Shape rows of pose k that the rows of the pose before would foretell, were every marker's
// reading the same: basis_k' basis_(k-1) rows.
Eigen::MatrixXd Foretold(const LinearProblem& problem,
                         const Eigen::MatrixXd& rows,
                         const std::vector<Eigen::Index>& starts,
                         int k) {
  return problem.shape_basis[k].transpose() *
         (problem.shape_basis[k - 1] * rows.middleRows(starts[k - 1], starts[k] - starts[k - 1]));
}

void FitShapeCorrelation(const LinearProblem& problem, GapNoise* noise) {
  Eigen::MatrixXd all(problem.shape_error.size(),
                      problem.shape_nuisance.cols() + problem.shape_trend.cols());
  all << problem.shape_nuisance, problem.shape_trend;
  const Projection p = Project(WhitenShapeRows(problem, *noise, all),
                               WhitenShapeRows(problem, *noise, problem.shape_error));
  const std::vector<Eigen::Index> starts = ShapeStarts(problem);
  double product = 0.0, square = 0.0;
  for (int k = 1; k < problem.poses; ++k) {
    const Eigen::VectorXd before = Foretold(problem, p.residual, starts, k);
    product += before.dot(p.residual.segment(starts[k], starts[k + 1] - starts[k]));
    square += before.squaredNorm();
  }
  if (!(square > 0.0)) return;
  const double raw = product / square;
  const double found = raw + Taken(raw, problem.poses);
  if (found > kClear / std::sqrt(static_cast<double>(p.residual.size())))
    noise->shape_correlation = std::min(found, 0.97);
}

void FitShape(const LinearProblem& problem, GapNoise* noise) {
  noise->shape_weight = Eigen::VectorXd::Ones(problem.poses);
  if (problem.shape_error.size() == 0) return;
  const Projection p = Project(problem.shape_nuisance, problem.shape_error);
  Eigen::VectorXd squared = Eigen::VectorXd::Zero(problem.poses);
  for (Eigen::Index row = 0; row < p.residual.size(); ++row)
    squared[problem.shape_pose[row]] += p.residual[row] * p.residual[row];
  const double freedom =
      std::accumulate(problem.shape_freedom.begin(), problem.shape_freedom.end(), 0.0);
  const double dimension = freedom / problem.poses;
  const double left = std::max(freedom - static_cast<double>(p.basis.cols()), 1.0);
  noise->shape_factor = squared.sum() / left;
  if (!(noise->shape_factor > 0.0)) noise->shape_factor = 1.0;
  const double tail = TailFreedom(squared, dimension);
  if (tail != 0.0) {
    noise->shape_weight = Weights(squared, tail, dimension);
    noise->shape_factor = noise->shape_weight.dot(squared) / left;
  }
  // Whitened by the stated noise of a reading, as the first component is made of it.
  noise->shape_factor = std::max(noise->shape_factor, LeastFactor(problem, 0));
  FitShapeCorrelation(problem, noise);
}

// -2 ln of the likelihood of pose and shape rows, without what is the same for all noises.
double Deviance(const LinearProblem& problem, const GapNoise& noise) {
  const Projection pose = Project(WhitenPoseRows(problem, noise, problem.nuisance),
                                  WhitenPoseRows(problem, noise, problem.error));
  double sum = pose.residual.squaredNorm();
  for (int k = 0; k < problem.poses; ++k) {
    sum += 2.0 * noise.Root(problem, k).diagonal().array().log().sum();
    sum -= 6.0 * std::log(noise.weight[k]);
  }
  sum += 6.0 * (problem.poses - 1) * std::log1p(-noise.correlation * noise.correlation);
  if (problem.shape_error.size() == 0) return sum;
  const Projection shape = Project(WhitenShapeRows(problem, noise, problem.shape_nuisance),
                                   WhitenShapeRows(problem, noise, problem.shape_error));
  sum += shape.residual.squaredNorm();
  const double kept = 1.0 - noise.shape_correlation * noise.shape_correlation;
  for (int k = 0; k < problem.poses; ++k)
    sum += problem.shape_freedom[k] *
           std::log((k > 0 ? kept : 1.0) * noise.shape_factor / noise.shape_weight[k]);
  return sum;
}

}  // namespace

Matrix6d GapNoise::Root(const LinearProblem& problem, int pose) const {
  return Covariance(problem, factor, pose).llt().matrixL();
}

Eigen::MatrixXd WhitenPoseRows(const LinearProblem& problem,
                               const GapNoise& noise,
                               const Eigen::MatrixXd& m) {
  Eigen::MatrixXd white(m.rows(), m.cols());
  for (int k = 0; k < problem.poses; ++k) {
    // An inverse of six rows costs little and makes the product over many columns one sweep.
    const Matrix6d inverse =
        std::sqrt(noise.weight[k]) *
        noise.Root(problem, k).triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
    white.middleRows(6 * k, 6).noalias() = inverse * m.middleRows(6 * k, 6);
  }
  if (noise.correlation == 0.0) return white;
  const double rest = 1.0 / std::sqrt(1.0 - noise.correlation * noise.correlation);
  for (int k = problem.poses - 1; k > 0; --k)
    white.middleRows(6 * k, 6) =
        rest * (white.middleRows(6 * k, 6) - noise.correlation * white.middleRows(6 * (k - 1), 6));
  return white;
}

Eigen::MatrixXd WhitenShapeRows(const LinearProblem& problem,
                                const GapNoise& noise,
                                const Eigen::MatrixXd& m) {
  Eigen::MatrixXd white = m;
  for (Eigen::Index row = 0; row < m.rows(); ++row)
    white.row(row) *= std::sqrt(noise.shape_weight[problem.shape_pose[row]] / noise.shape_factor);
  if (noise.shape_correlation == 0.0 || m.rows() == 0) return white;
  const std::vector<Eigen::Index> starts = ShapeStarts(problem);
  const double rho = noise.shape_correlation, rest = 1.0 / std::sqrt(1.0 - rho * rho);
  for (int k = problem.poses - 1; k > 0; --k) {
    const Eigen::MatrixXd before = Foretold(problem, white, starts, k);
    auto rows = white.middleRows(starts[k], starts[k + 1] - starts[k]);
    rows = rest * (rows - rho * before);
  }
  return white;
}

GapNoise EstimateGapNoise(const LinearProblem& problem, const Eigen::MatrixXd& trend) {
  GapNoise noise;
  noise.weight = Eigen::VectorXd::Ones(problem.poses);
  noise.factor.assign(problem.components.size(), 1.0);
  // Every component starts with an equal share of what is there.
  const Projection plain = Project(problem.nuisance, problem.error);
  for (std::size_t c = 0; c < noise.factor.size(); ++c) {
    double position = 0.0, position_there = 0.0, orientation = 0.0, orientation_there = 0.0;
    for (int k = 0; k < problem.poses; ++k) {
      const Vector6d r = plain.residual.segment<6>(6 * k);
      position_there += r.head<3>().squaredNorm(), orientation_there += r.tail<3>().squaredNorm();
      position += problem.components[c][k].topLeftCorner<3, 3>().trace();
      orientation += problem.components[c][k].bottomRightCorner<3, 3>().trace();
    }
    double factor = 0.0;
    if (position > 0.0) factor = position_there / position;
    if (orientation > 0.0 && (factor == 0.0 || orientation_there / orientation < factor))
      factor = orientation_there / orientation;
    noise.factor[c] = factor / static_cast<double>(noise.factor.size());
  }
  FitFactors(problem, &noise);
  FitTails(problem, &noise);
  FitCorrelation(problem, trend, &noise);
  FitShape(problem, &noise);
  noise.deviance = Deviance(problem, noise);
  return noise;
}

}  // namespace hexcal
