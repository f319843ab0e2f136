// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/plan_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "discovery/exchange.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr double kRank = 1e-7;           // of columns, scaled to length one
constexpr double kUndetermined = 1e-13;  // of the scaled information
constexpr double kExact = 1e-6;          // of the squared size
constexpr double kNothing = 1e-3;        // sigmas
constexpr int kMostPoses = 500;          // worth a thought

std::vector<int> Without(const std::vector<int>& all, std::size_t k) {
  std::vector<int> others = all;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
  return others;
}

std::vector<int> Together(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

double SquaredDistance(const DesignModel& model,
                       const DesignRows& rows,
                       const std::vector<int>& poses) {
  if (poses.empty()) return 0.0;
  const Eigen::MatrixXd basis = OrthonormalBasis(RowsOf(rows, model.columns, poses), kRank);
  const Eigen::VectorXd signal = RowsOf(rows, model.signal, poses);
  return (signal - basis * (basis.transpose() * signal)).squaredNorm();
}

std::vector<int> AllOf(const DesignRows& rows) {
  std::vector<int> all(rows.poses());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

Vector12d Deviations(const DesignModel& parameters,
                     const DesignRows& rows,
                     const std::vector<int>& poses) {
  const Eigen::MatrixXd x = RowsOf(rows, parameters.columns, poses);
  Eigen::MatrixXd information = x.transpose() * x;
  information.diagonal() += parameters.prior;
  Eigen::VectorXd scale = information.diagonal();
  for (double& s : scale) s = s > 0.0 ? 1.0 / std::sqrt(s) : 0.0;
  const Eigenvalues eigen =
      DecomposeSymmetric(scale.asDiagonal() * information * scale.asDiagonal());
  const Eigen::Index first = information.cols() - 12;
  Vector12d variance = Vector12d::Zero(), lost = Vector12d::Zero();
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
    const Vector12d squares = eigen.vectors.col(k).tail<12>().cwiseAbs2();
    if (eigen.values[k] > kUndetermined)
      variance += squares / eigen.values[k];
    else
      lost += squares;
  }
  Vector12d deviation = variance.cwiseSqrt().cwiseProduct(scale.tail<12>());
  for (int k = 0; k < 12; ++k)
    if (lost[k] > 1e-6 || scale[first + k] == 0.0)
      deviation[k] = std::numeric_limits<double>::quiet_NaN();
  return deviation;
}

double DistanceOf(const std::vector<DesignModel>& forms,
                  const DesignRows& rows,
                  const std::vector<int>& poses) {
  if (forms.empty()) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const DesignModel& form : forms)
    nearest = std::min(nearest, SquaredDistance(form, rows, poses));
  return std::sqrt(nearest);
}

void MeasureDistances(const DesignRows& rows,
                      const DesignModel& alone,
                      const std::vector<DesignModel>& forms,
                      const std::vector<int>& before,
                      const std::vector<int>& after,
                      RivalPair* pair) {
  pair->size_before = DistanceOf({alone}, rows, before);
  pair->size_after = DistanceOf({alone}, rows, after);
  pair->before = DistanceOf(forms, rows, before);
  pair->after = DistanceOf(forms, rows, after);
}

void MeasureWholePool(const DesignRows& rows,
                      const DesignModel& alone,
                      const std::vector<DesignModel>& forms,
                      RivalPair* pair) {
  const std::vector<int> all = AllOf(rows);
  const double size = DistanceOf({alone}, rows, all);
  pair->whole_pool = DistanceOf(forms, rows, all);
  pair->is_absorbed = !(size > kNothing);
  pair->is_exact =
      pair->is_absorbed || !(pair->whole_pool * pair->whole_pool > kExact * size * size);
}

void Classify(int planned, RivalPair* pair) {
  const double before = pair->before * pair->before, after = pair->after * pair->after;
  const double each = (after - before) / planned;
  const double needed = each > 0.0 ? std::ceil((kApart - before) / each) : kMostPoses + 1.0;
  const bool can = !pair->is_exact && needed <= kMostPoses;
  pair->poses_needed = can ? std::max(0, static_cast<int>(needed)) : 0;
  pair->separation = before >= kApart  ? Separation::kAlready
                     : after >= kApart ? Separation::kByPlan
                     : can             ? Separation::kByMore
                                       : Separation::kNotByPoses;
}

std::vector<PoseReason> Reasons(const DesignModel& parameters,
                                const std::vector<std::vector<DesignModel>>& pairs,
                                const DesignRows& rows,
                                const std::vector<int>& known,
                                const std::vector<int>& planned) {
  const auto count = [](double distance) { return std::log1p(distance * distance / kApart); };
  const std::vector<int> all = Together(known, planned);
  std::vector<double> whole;
  for (const auto& forms : pairs) whole.push_back(count(DistanceOf(forms, rows, all)));
  const Vector12d deviation = Deviations(parameters, rows, all);
  std::vector<PoseReason> reasons;
  for (std::size_t k = 0; k < planned.size(); ++k) {
    const std::vector<int> others = Together(known, Without(planned, k));
    PoseReason reason;
    double most = 0.0;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const double loss = whole[p] - count(DistanceOf(pairs[p], rows, others));
      if (loss > most) most = loss, reason.pair = static_cast<int>(p);
    }
    if (reason.pair < 0) {
      // What is lost altogether counts most.
      const Vector12d without = Deviations(parameters, rows, others);
      for (int i = 0; i < 12; ++i) {
        const double loss =
            std::isnan(without[i]) ? std::numeric_limits<double>::max() : without[i] / deviation[i];
        if (loss > most) most = loss, reason.parameter = i;
      }
    }
    reasons.push_back(reason);
  }
  return reasons;
}

}  // namespace hexcal
