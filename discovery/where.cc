// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "discovery/score.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr double kRank = 1e-7;
constexpr std::size_t kMostPoses = 10;
constexpr std::array<const char*, 6> kAxes = {
    "tool x", "tool y", "tool z", "tool rx", "tool ry", "tool rz"};

// p of the smallest of `many`.
double Sidak(double p, double many) {
  return -std::expm1(many * std::log1p(-std::min(p, 0.999999)));
}

// Rows that base and tool leave, whitened, and how much of each pose they took.
struct Left {
  Eigen::VectorXd residual;
  Eigen::MatrixXd basis;
};
Left LeftOf(const LinearProblem& problem, const GapNoise& noise) {
  Left left;
  left.basis = OrthonormalBasis(WhitenPoseRows(problem, noise, problem.nuisance), kRank);
  const Eigen::VectorXd error = WhitenPoseRows(problem, noise, problem.error);
  left.residual = error - left.basis * (left.basis.transpose() * error);
  return left;
}

std::vector<WhereItem> Poses(const LinearProblem& problem,
                             const Left& left,
                             const std::vector<std::string>& labels) {
  std::vector<WhereItem> poses;
  const double excess = std::max(left.residual.squaredNorm() - (6.0 * problem.poses - 12.0), 1e-9);
  for (int k = 0; k < problem.poses; ++k) {
    const Eigen::MatrixXd q = left.basis.middleRows(6 * k, 6);
    const Eigen::MatrixXd kept = Eigen::MatrixXd::Identity(6, 6) - q * q.transpose();
    const Eigen::VectorXd r = left.residual.segment(6 * k, 6);
    const double shift = r.dot(ShortestSolution(kept, r, 1e-9));
    poses.push_back({"pose " + labels[k],
                     Sidak(ChiSquareTail(shift, 6.0), problem.poses),
                     std::clamp((r.squaredNorm() - 6.0) / excess, 0.0, 1.0)});
  }
  std::stable_sort(poses.begin(), poses.end(), [](const WhereItem& a, const WhereItem& b) {
    return a.p_value < b.p_value;
  });
  if (poses.size() > kMostPoses) poses.resize(kMostPoses);
  return poses;
}

// Each axis' squares against what noise leaves there.
std::vector<WhereItem> Axes(const LinearProblem& problem, const GapNoise& noise, const Left& left) {
  std::vector<WhereItem> axes;
  double all = 1e-9;
  for (int axis = 0; axis < 6; ++axis) {
    double found = 0.0, expected = 0.0;
    for (int k = 0; k < problem.poses; ++k) {
      const Matrix6d root = noise.Root(problem, k) / std::sqrt(noise.weight[k]);
      const Eigen::MatrixXd q = left.basis.middleRows(6 * k, 6);
      const Matrix6d covariance =
          root * (Matrix6d::Identity() - q * q.transpose()) * root.transpose();
      const double r = root.row(axis).dot(left.residual.segment<6>(6 * k));
      found += r * r / covariance(axis, axis);
      expected += 1.0;
    }
    const double freedom = expected - 2.0;
    axes.push_back({kAxes[axis],
                    Sidak(ChiSquareTail(found * freedom / expected, freedom), 6.0),
                    std::max(found - expected, 0.0)});
    all += axes.back().share;
  }
  for (WhereItem& item : axes) item.share /= all;
  return axes;
}

// The best family of each group, its search paid for and the group's number too.
std::vector<WhereItem> Grouped(const SelectionStep& step,
                               const std::vector<std::string>& groups,
                               double excess) {
  std::map<std::string, WhereItem> best;
  std::map<std::string, int> members;
  for (std::size_t k = 0; k < step.families.size() && k < step.paid.size(); ++k) {
    const std::string& group = groups[step.families[k].family];
    if (group.empty()) continue;
    ++members[group];
    const double p = std::pow(10.0, -step.paid[k]);
    WhereItem& item = best.try_emplace(group, WhereItem{group, 1.0, 0.0}).first->second;
    if (p <= item.p_value) item.p_value = p;
    item.share = std::max(item.share, std::clamp(step.families[k].best.gain / excess, 0.0, 1.0));
  }
  std::vector<WhereItem> items;
  for (auto& [group, item] : best) {
    item.p_value = Sidak(item.p_value, members[group] * static_cast<double>(best.size()));
    items.push_back(item);
  }
  std::stable_sort(items.begin(), items.end(), [](const WhereItem& a, const WhereItem& b) {
    return a.p_value < b.p_value;
  });
  return items;
}

// Legs alone, by every form that one leg may have.
std::vector<WhereItem> Legs(const LinearProblem& problem, const Scorer& scorer, double excess) {
  std::vector<WhereItem> legs;
  for (int leg = 1; leg <= 6; ++leg) {
    double log10_p = 0.0, gain = 0.0;
    int tried = 0;
    for (const Score& score : scorer.scores()) {
      const Form& form = problem.forms[score.form];
      const std::string& name = problem.families[form.family].name;
      if (form.index != std::vector<int>{leg} || name.rfind("marker", 0) == 0) continue;
      if (score.rank == 0) continue;
      ++tried;
      if (score.log10_p < log10_p) log10_p = score.log10_p, gain = score.gain;
    }
    if (tried == 0) return {};
    legs.push_back({fmt::format("leg {}", leg),
                    Sidak(std::pow(10.0, log10_p), 6.0 * tried),
                    std::clamp(gain / excess, 0.0, 1.0)});
  }
  return legs;
}

}  // namespace

Where Localise(const LinearProblem& problem,
               const GapNoise& noise,
               const SelectionStep& first_step,
               const std::vector<std::string>& pose_labels,
               const std::vector<std::string>& family_sites,
               const std::vector<std::string>& family_drivers) {
  Where where;
  const Left left = LeftOf(problem, noise);
  const Scorer scorer(problem, noise);
  const double excess = std::max(scorer.squared_residual() - scorer.freedom(), 1e-9);
  where.poses = Poses(problem, left, pose_labels);
  where.axes = Axes(problem, noise, left);
  where.legs = Legs(problem, scorer, excess);
  where.covariates = Grouped(first_step, family_drivers, excess);
  where.sites = Grouped(first_step, family_sites, excess);
  return where;
}

std::vector<Detectable> DetectableSizes(const LinearProblem& problem,
                                        const GapNoise& noise,
                                        const std::vector<int>& chosen,
                                        double alpha,
                                        const std::vector<std::string>& units) {
  std::vector<Detectable> sizes;
  const Scorer scorer(problem.With(chosen), noise);
  // 80 % power of a two-sided test of one number, every family paying its share of alpha.
  const double share = alpha / static_cast<double>(problem.families.size());
  const double needed = std::sqrt(ChiSquareQuantile(1.0 - share, 1.0)) + 0.8416;
  std::map<int, Detectable> best;
  for (const Score& score : scorer.scores()) {
    const Form& form = problem.forms[score.form];
    const Family& family = problem.families[form.family];
    if (family.is_described || score.rank < form.size) continue;
    const double size = needed * std::sqrt(scorer.CoefficientCovariance(score.form)(0, 0));
    const auto [at, is_new] = best.try_emplace(
        form.family, Detectable{family.name, form.index, units[form.family], size});
    if (!is_new && size < at->second.smallest)
      at->second.smallest = size, at->second.index = form.index;
  }
  for (const auto& [family, detectable] : best) sizes.push_back(detectable);
  return sizes;
}

}  // namespace hexcal
