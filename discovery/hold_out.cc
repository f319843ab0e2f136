// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/hold_out.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "discovery/joint_fit.h"
#include "discovery/score.h"

namespace hexcal {
namespace {

Eigen::MatrixXd Rows(const Eigen::MatrixXd& m, const std::vector<int>& poses) {
  Eigen::MatrixXd some(6 * poses.size(), m.cols());
  for (std::size_t i = 0; i < poses.size(); ++i)
    some.middleRows(6 * static_cast<Eigen::Index>(i), 6) = m.middleRows(6 * poses[i], 6);
  return some;
}

// Residuals of the test poses under a fit to the others.
Eigen::VectorXd Predicted(const LinearProblem& train,
                          const LinearProblem& test,
                          const GapNoise& noise,
                          const std::vector<int>& forms) {
  // What the poses determine badly is held to the size that they make likely.
  const double width = forms.empty() ? 1.0 : Scorer(train.Only(forms), noise).LikeliestWidth(0);
  const JointFit fit = FitJointly(train, noise, forms, width, Eigen::VectorXd());
  Eigen::VectorXd x(fit.mounts.size() + fit.coefficients.size());
  x << fit.mounts, fit.coefficients;
  return test.error - test.With(forms).nuisance * x;
}

void Put(const Eigen::VectorXd& part, const std::vector<int>& poses, Eigen::VectorXd* whole) {
  for (std::size_t i = 0; i < poses.size(); ++i)
    whole->segment<6>(6 * poses[i]) = part.segment<6>(6 * static_cast<Eigen::Index>(i));
}

std::set<int> FamiliesOf(const LinearProblem& problem, const std::vector<int>& forms) {
  std::set<int> families;
  for (const int f : forms) families.insert(problem.forms[f].family);
  return families;
}

}  // namespace

std::vector<std::vector<int>> HoldOutFolds(int poses, int folds, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<std::vector<int>> parts(folds);
  std::vector<int> order(folds);
  for (int first = 0; first < poses; first += folds) {
    std::iota(order.begin(), order.end(), 0);
    for (int i = folds - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<int>(generator() % static_cast<unsigned>(i + 1))]);
    for (int i = 0; i < folds && first + i < poses; ++i) parts[order[i]].push_back(first + i);
  }
  return parts;
}

std::vector<int> AllBut(int poses, const std::vector<int>& left_out) {
  std::vector<int> rest;
  for (int k = 0; k < poses; ++k)
    if (!std::binary_search(left_out.begin(), left_out.end(), k)) rest.push_back(k);
  return rest;
}

GapNoise RestrictedNoise(const GapNoise& noise, const std::vector<int>& poses) {
  GapNoise part = noise;
  part.weight.resize(static_cast<Eigen::Index>(poses.size()));
  part.shape_weight.resize(part.weight.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    part.weight[i] = noise.weight[poses[i]];
    part.shape_weight[i] = noise.shape_weight[poses[i]];
  }
  part.correlation = 0.0;
  return part;
}

GapSize SizeOf(const LinearProblem& problem,
               const GapNoise& noise,
               const Eigen::VectorXd& residual,
               int parameters) {
  GapSize size;
  double position = 0.0, orientation = 0.0;
  for (int k = 0; k < problem.poses; ++k) {
    position += residual.segment<3>(6 * k).squaredNorm();
    orientation += residual.segment<3>(6 * k + 3).squaredNorm();
  }
  size.rms_position = std::sqrt(position / problem.poses);
  size.rms_orientation = std::sqrt(orientation / problem.poses);
  GapNoise plain = noise;
  plain.correlation = 0.0;
  size.chi_square = WhitenPoseRows(problem, plain, residual).squaredNorm();
  size.degrees_of_freedom = 6 * problem.poses - parameters;
  return size;
}

HeldOut HoldOut(const LinearProblem& problem,
                const Eigen::MatrixXd& trend,
                const Selection& whole,
                int folds,
                std::uint64_t seed,
                const std::function<void(int done)>& progress) {
  HeldOut held;
  const Eigen::Index rows = problem.error.size();
  Eigen::VectorXd before(rows), after(rows);
  std::vector<Eigen::VectorXd> steps(whole.chosen.size() + 1, Eigen::VectorXd(rows));
  folds = std::min(folds, problem.poses / 2);
  int done = 0;
  for (const std::vector<int>& part : HoldOutFolds(problem.poses, folds, seed)) {
    const std::vector<int> rest = AllBut(problem.poses, part);
    const LinearProblem train = problem.Restricted(rest), test = problem.Restricted(part);
    SelectOptions options;
    options.thresholds = whole.thresholds;
    const Selection chosen = Select(train, Rows(trend, rest), options);
    if (FamiliesOf(problem, chosen.chosen) == FamiliesOf(problem, whole.chosen))
      ++held.folds_agreeing;
    const GapNoise noise = RestrictedNoise(whole.noise, rest);
    Put(Predicted(train, test, noise, {}), part, &before);
    Put(Predicted(train, test, noise, chosen.chosen), part, &after);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const std::vector<int> first(whole.chosen.begin(),
                                   whole.chosen.begin() + static_cast<std::ptrdiff_t>(k));
      Put(Predicted(train, test, noise, first), part, &steps[k]);
    }
    if (progress) progress(++done);
  }
  held.before = SizeOf(problem, whole.noise, before, 0);
  held.after = SizeOf(problem, whole.noise, after, 0);
  for (const Eigen::VectorXd& residual : steps)
    held.after_steps.push_back(SizeOf(problem, whole.noise, residual, 0).rms_position);
  return held;
}

}  // namespace hexcal
