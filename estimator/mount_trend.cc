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
  int records = 0;
  bool scatter_shows = false;
  double homogeneity_p = 1.0;
  Vector12d between_variance = Vector12d::Zero();
};

Reference ReferenceOf(const std::vector<Position>& in_control) {
  Reference reference;
  reference.records = static_cast<int>(in_control.size());
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

// Of e, whose covariance is that and has been estimated from so many records.
ChartTest TestOf(const Vector12d& e,
                 const Matrix12d& covariance,
                 const Reference& reference,
                 double alpha) {
  const bool shows = reference.scatter_shows;
  const double nu = reference.records - 1.0;
  const double quantile = shows ? StudentTQuantile(1.0 - 0.5 * alpha / kDof, nu)
                                : std::sqrt(ChiSquareQuantile(1.0 - alpha / kDof, 1.0));
  ChartTest test;
  test.deviation = e;
  test.half_width = quantile * covariance.diagonal().cwiseSqrt();
  test.t_squared = e.dot(SpdFactor<kDof>(covariance).Solve(e));
  test.t_squared_limit =
      shows ? kDof * FisherFQuantile(1.0 - alpha, kDof, nu) : ChiSquareQuantile(1.0 - alpha, kDof);
  test.p_value =
      shows ? FisherFTail(test.t_squared / kDof, kDof, nu) : ChiSquareTail(test.t_squared, kDof);
  test.is_in_control = test.p_value >= alpha;
  for (int i = 0; i < kDof; ++i) {
    test.outside[i] = !(std::abs(e[i]) <= test.half_width[i]);
    if (test.outside[i]) test.is_in_control = false;
  }
  return test;
}

Matrix12d WithBetween(const Position& position, const Reference& reference) {
  Matrix12d covariance = position.covariance;
  covariance.diagonal() += reference.between_variance;
  return covariance;
}

ChartTest TestLevel(const Reference& reference, const Position& position, double alpha) {
  return TestOf(position.d - reference.mean.value,
                WithBetween(position, reference) + reference.mean.covariance,
                reference,
                alpha);
}

// The moving mean of the records after a baseline, from the baseline's own mean: known is the
// covariance of its share of the records, start what is left of the baseline in it.
class MovingMean {
 public:
  MovingMean(const Reference& baseline, double weight)
      : baseline_(baseline), weight_(weight), mean_(baseline.mean.value) {}

  ChartTest Add(const Position& position, double alpha) {
    const double rest = 1.0 - weight_;
    mean_ = rest * mean_ + weight_ * position.d;
    known_ = rest * rest * known_ + weight_ * weight_ * WithBetween(position, baseline_);
    start_ *= rest;
    return TestOf(mean_ - baseline_.mean.value,
                  known_ + (1.0 - start_) * (1.0 - start_) * baseline_.mean.covariance,
                  baseline_,
                  alpha);
  }

 private:
  Reference baseline_;
  double weight_;
  Vector12d mean_;
  Matrix12d known_ = Matrix12d::Zero();
  double start_ = 1.0;
};

// A straight line through positions over s, which is 0 at the first.
struct Line {
  Vector12d rate;
  Matrix12d information;  // of the rate
  double q = 0.0;         // the squared deviations from it
  std::vector<Vector12d> deviations;
};

std::optional<Line> FitLine(const std::vector<Position>& positions,
                            const std::vector<double>& s,
                            const Vector12d& between_variance) {
  Matrix12d w0 = Matrix12d::Zero(), w1 = w0, w2 = w0;
  Vector12d r0 = Vector12d::Zero(), r1 = r0;
  std::vector<Matrix12d> weights;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    Matrix12d covariance = positions[k].covariance;
    covariance.diagonal() += between_variance;
    weights.push_back(SpdFactor<kDof>(covariance).Inverse());
    const Vector12d weighted = weights[k] * positions[k].d;
    w0 += weights[k];
    w1 += s[k] * weights[k];
    w2 += s[k] * s[k] * weights[k];
    r0 += weighted;
    r1 += s[k] * weighted;
  }
  Line line;
  const SpdFactor<kDof> level(w0);
  const Matrix12d reduced = w2 - w1 * level.Inverse() * w1;
  line.information = 0.5 * (reduced + reduced.transpose());
  const SpdFactor<kDof> slope(line.information);
  if (!(slope.smallest_pivot() > 0.0)) return std::nullopt;
  line.rate = slope.Solve(r1 - w1 * level.Solve(r0));
  const Vector12d offset = level.Solve(r0 - w1 * line.rate);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    line.deviations.push_back(positions[k].d - offset - s[k] * line.rate);
    line.q += line.deviations[k].dot(weights[k] * line.deviations[k]);
  }
  return line;
}

// What the deviations of a parameter from a line have beyond its variances within.
double BetweenVariance(const Line& line, const std::vector<Position>& positions, int i) {
  double q = 0.0, w = 0.0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    q += line.deviations[k][i] * line.deviations[k][i] / positions[k].covariance(i, i);
    w += 1.0 / positions[k].covariance(i, i);
  }
  const double records = static_cast<double>(positions.size());
  return std::max(0.0, (q / (records - 2.0) - 1.0) * records / w);
}

std::optional<MountDrift> DriftOf(const std::vector<Position>& positions) {
  if (positions.size() < 3) return std::nullopt;
  double longest = 0.0;
  for (const Position& p : positions)
    longest = std::max(longest, std::abs(p.time - positions.front().time));
  if (!(longest > 0.0)) return std::nullopt;
  std::vector<double> s;  // times in units of the longest, for the numbers' sake
  for (const Position& p : positions) s.push_back((p.time - positions.front().time) / longest);
  std::optional<Line> line = FitLine(positions, s, Vector12d::Zero());
  if (!line) return std::nullopt;
  const double dof = static_cast<double>(positions.size() - 2);
  MountDrift drift;
  drift.scatter_shows = !(ChiSquareTail(line->q, kDof * dof) >= kScatterLevel);
  if (drift.scatter_shows) {
    Vector12d between;
    for (int i = 0; i < kDof; ++i) between[i] = BetweenVariance(*line, positions, i);
    line = FitLine(positions, s, between);
    if (!line) return std::nullopt;
  }
  drift.rate = line->rate / longest;
  drift.standard_deviation =
      SpdFactor<kDof>(line->information).Inverse().diagonal().cwiseSqrt() / longest;
  drift.statistic = line->rate.dot(line->information * line->rate);
  drift.p_value = drift.scatter_shows ? FisherFTail(drift.statistic / kDof, kDof, dof)
                                      : ChiSquareTail(drift.statistic, kDof);
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
  std::optional<MovingMean> moving;
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
    point.is_judged = static_cast<int>(used.size()) > options.baseline;
    if (point.is_judged) {
      const Reference reference = ReferenceOf(in_control);
      if (!moving) moving.emplace(reference, options.moving_weight);
      point.level = TestLevel(reference, used.back(), options.alpha);
      if (point.level.is_in_control) point.moving = moving->Add(used.back(), options.alpha);
      point.is_in_control = point.level.is_in_control && point.moving.is_in_control;
    }
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
