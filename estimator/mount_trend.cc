// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/mount_trend.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"
#include "estimator/spd_factor.h"

namespace hexcal {
namespace {

constexpr double kScatterLevel = 0.05;
constexpr int kDof = 12;

struct Position {
  Vector12d d = Vector12d::Zero();
  Matrix12d covariance = Matrix12d::Zero();
  double time = 0.0;
};

struct Mean {
  Vector12d value = Vector12d::Zero();
  Matrix12d covariance = Matrix12d::Zero();
  double q = 0.0;  // Cochran's: the squared deviations from it
};

Mean MeanOf(const std::vector<Position>& positions, const Vector12d& between_variance) {
  Matrix12d information = Matrix12d::Zero();
  Vector12d right = Vector12d::Zero();
  std::vector<Matrix12d> weights;
  for (const Position& p : positions) {
    Matrix12d covariance = p.covariance;
    covariance.diagonal() += between_variance;
    weights.push_back(SpdFactor<kDof>(covariance).Inverse());
    information += weights.back();
    right += weights.back() * p.d;
  }
  Mean mean;
  const SpdFactor<kDof> factor(information);
  mean.covariance = factor.Inverse();
  mean.value = factor.Solve(right);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector12d e = positions[i].d - mean.value;
    mean.q += e.dot(weights[i] * e);
  }
  return mean;
}

// DerSimonian and Laird's variance between records of one parameter, from the variances within.
double BetweenVariance(const std::vector<Position>& positions, int i) {
  double w1 = 0.0, w2 = 0.0, wd = 0.0, q = 0.0;
  for (const Position& p : positions) {
    const double w = 1.0 / p.covariance(i, i);
    w1 += w;
    w2 += w * w;
    wd += w * p.d[i];
  }
  for (const Position& p : positions) {
    const double e = p.d[i] - wd / w1;
    q += e * e / p.covariance(i, i);
  }
  return std::max(0.0, (q - static_cast<double>(positions.size() - 1)) / (w1 - w2 / w1));
}

// What the records in control say of the next one.
struct Reference {
  Mean mean;
  bool scatter_shows = false;
  double homogeneity_p = 1.0;
  Vector12d between_variance = Vector12d::Zero();
};

Reference ReferenceOf(const std::vector<Position>& in_control) {
  Reference reference;
  reference.mean = MeanOf(in_control, Vector12d::Zero());
  if (in_control.size() < 2) return reference;
  const double dof = kDof * static_cast<double>(in_control.size() - 1);
  reference.homogeneity_p = ChiSquareTail(reference.mean.q, dof);
  reference.scatter_shows = !(reference.homogeneity_p >= kScatterLevel);
  if (!reference.scatter_shows) return reference;
  for (int i = 0; i < kDof; ++i) reference.between_variance[i] = BetweenVariance(in_control, i);
  reference.mean = MeanOf(in_control, reference.between_variance);
  return reference;
}

void Judge(const std::vector<Position>& in_control,
           const Position& position,
           double alpha,
           TrendPoint* point) {
  const Reference reference = ReferenceOf(in_control);
  Matrix12d covariance = position.covariance + reference.mean.covariance;
  covariance.diagonal() += reference.between_variance;
  const Vector12d e = position.d - reference.mean.value;
  const double nu = static_cast<double>(in_control.size()) - 1.0;
  const bool shows = reference.scatter_shows;
  const double quantile = shows ? StudentTQuantile(1.0 - 0.5 * alpha / kDof, nu)
                                : std::sqrt(ChiSquareQuantile(1.0 - alpha / kDof, 1.0));
  point->is_judged = true;
  point->centre = reference.mean.value;
  point->half_width = quantile * covariance.diagonal().cwiseSqrt();
  point->t_squared = e.dot(SpdFactor<kDof>(covariance).Solve(e));
  point->t_squared_limit =
      shows ? kDof * FisherFQuantile(1.0 - alpha, kDof, nu) : ChiSquareQuantile(1.0 - alpha, kDof);
  point->p_value = shows ? FisherFTail(point->t_squared / kDof, kDof, nu)
                         : ChiSquareTail(point->t_squared, kDof);
  point->is_in_control = point->p_value >= alpha;
  for (int i = 0; i < kDof; ++i) {
    point->outside[i] = !(std::abs(e[i]) <= point->half_width[i]);
    if (point->outside[i]) point->is_in_control = false;
  }
}

std::optional<MountDrift> DriftOf(const std::vector<Position>& positions) {
  if (positions.size() < 3) return std::nullopt;
  const double start = positions.front().time;
  double longest = 0.0;
  for (const Position& p : positions) longest = std::max(longest, std::abs(p.time - start));
  if (!(longest > 0.0)) return std::nullopt;
  // Times in units of the longest, for the numbers' sake; W sums of the weights.
  Matrix12d w0 = Matrix12d::Zero(), w1 = w0, w2 = w0;
  Vector12d r0 = Vector12d::Zero(), r1 = r0;
  std::vector<Matrix12d> weights;
  for (const Position& p : positions) {
    const double s = (p.time - start) / longest;
    weights.push_back(SpdFactor<kDof>(p.covariance).Inverse());
    w0 += weights.back();
    w1 += s * weights.back();
    w2 += s * s * weights.back();
    r0 += weights.back() * p.d;
    r1 += s * (weights.back() * p.d);
  }
  const SpdFactor<kDof> level(w0);
  const Matrix12d reduced = w2 - w1 * level.Inverse() * w1;
  const SpdFactor<kDof> slope(0.5 * (reduced + reduced.transpose()));
  if (!(slope.smallest_pivot() > 0.0)) return std::nullopt;
  const Vector12d rate = slope.Solve(r1 - w1 * level.Solve(r0));
  const Vector12d offset = level.Solve(r0 - w1 * rate);
  double q = 0.0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const Vector12d e = positions[k].d - offset - (positions[k].time - start) / longest * rate;
    q += e.dot(weights[k] * e);
  }
  const double dof = kDof * static_cast<double>(positions.size() - 2);
  MountDrift drift;
  const bool shows = !(ChiSquareTail(q, dof) >= kScatterLevel);
  drift.birge_ratio = std::max(1.0, std::sqrt(q / dof));
  const double scale = shows ? drift.birge_ratio : 1.0;
  drift.rate = rate / longest;
  drift.standard_deviation = scale / longest * slope.Inverse().diagonal().cwiseSqrt();
  drift.statistic = rate.dot(reduced * rate) / (scale * scale);
  drift.p_value =
      shows ? FisherFTail(drift.statistic / kDof, kDof, dof) : ChiSquareTail(drift.statistic, kDof);
  return drift;
}

bool IsUsable(const DatedMounts& record) {
  return record.is_trusted &&
         std::all_of(record.known.determined.begin(),
                     record.known.determined.end(),
                     [](bool is_determined) { return is_determined; }) &&
         record.known.covariance.allFinite() &&
         SpdFactor<kDof>(record.known.covariance).smallest_pivot() > 0.0;
}

}  // namespace

MountTrend TrendOf(const std::vector<DatedMounts>& records, const TrendOptions& options) {
  CHECK_GE(options.baseline, 1);
  MountTrend trend;
  std::vector<Position> used, in_control;
  const KnownMounts *first = nullptr, *before = nullptr;
  for (const DatedMounts& record : records) {
    TrendPoint& point = trend.points.emplace_back();
    point.is_used = IsUsable(record);
    if (!point.is_used) continue;
    if (first == nullptr) first = &record.known;
    if (before != nullptr) point.step = ChangeBetween(*before, record.known);
    before = &record.known;
    point.position = Minus(record.known.mounts, first->mounts);
    used.push_back({point.position, record.known.covariance, record.time});
    if (static_cast<int>(used.size()) > options.baseline)
      Judge(in_control, used.back(), options.alpha, &point);
    if (point.is_in_control) in_control.push_back(used.back());
  }
  trend.in_control = static_cast<int>(in_control.size());
  if (in_control.empty()) return trend;
  const Reference reference = ReferenceOf(in_control);
  trend.scatter_shows = reference.scatter_shows;
  trend.homogeneity_p = reference.homogeneity_p;
  trend.between = reference.between_variance.cwiseSqrt();
  trend.drift = DriftOf(used);
  return trend;
}

}  // namespace hexcal
