// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot_outliers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr std::size_t kFewestPoses = 6;
constexpr int kTriples = 500;
constexpr int kMaxGrowths = 20;
constexpr double kDof = 3.0;
// A noise that was stated is disproved by a chi-square that chance exceeds more rarely.
constexpr double kDisproved = 0.01;
// What is significant and at least this part of the worst goes out together with it.
constexpr double kFarOff = 0.5;

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Snooping {
 public:
  Snooping(const PivotPoses& poses, const PivotOptions& options)
      : poses_(poses),
        options_(options),
        count_(poses.items.size()),
        half_(count_ / 2 + 2),
        of_one_(-std::expm1(std::log1p(-options.alpha) / static_cast<double>(count_))),
        kept_(count_, false),
        came_back_(count_, false) {}

  std::vector<PivotOutlier> Run() {
    StartFromTriple();
    Solve();
    Grow();
    while (TakeOut() || TakeBack()) Solve();
    std::vector<PivotOutlier> outliers;
    for (std::size_t i = 0; i < count_; ++i)
      if (!kept_[i]) outliers.push_back(Describe(i));
    return outliers;
  }

 private:
  // The half that lies closest to the solution of some three poses.
  void StartFromTriple() {
    std::mt19937_64 rng(1);
    std::uniform_int_distribution<std::size_t> draw(0, count_ - 1);
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> best;
    for (int k = 0; k < kTriples; ++k) {
      const std::vector<std::size_t> triple = {draw(rng), draw(rng), draw(rng)};
      const std::vector<double> errors = ErrorsOf(triple);
      const double middle = Nearest(errors);
      if (!(middle < least)) continue;
      least = middle;
      best = errors;
    }
    if (best.empty()) {
      kept_.assign(count_, true);
      return;
    }
    for (std::size_t i = 0; i < count_; ++i) kept_[i] = best[i] <= least;
  }

  std::vector<double> ErrorsOf(const std::vector<std::size_t>& triple) const {
    std::vector<PivotPose> three;
    for (const std::size_t i : triple) three.push_back(poses_.items[i]);
    const Tilts tilts = FindTilts(three);
    std::array<bool, 3> is_lost{};
    // What three poses do not tilt, all may not either.
    for (int k = 0; k < 3; ++k) is_lost[k] = !(tilts.rms[k] > options_.least_tilt);
    const TipAndPivot x =
        SolvePivotAlgebraically(poses_.items, triple, ComplementOf(tilts, is_lost));
    std::vector<double> errors;
    for (const PivotPose& pose : poses_.items)
      errors.push_back(PivotError(pose.world_from_tool, x).squaredNorm());
    return errors;
  }

  // The largest squared error of the best half.
  double Nearest(std::vector<double> errors) const {
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(half_ - 1);
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
  }

  void Solve() {
    solution_ = SolvePivot(poses_, kept_, options_);
    const double chi_square = solution_.fit.squared_sigmas;
    const auto dof = static_cast<double>(solution_.fit.degrees_of_freedom);
    is_by_f_ = poses_.noise != PivotNoise::kKnown || ChiSquareTail(chi_square, dof) < kDisproved;
    scale_ = is_by_f_ ? chi_square / dof : 1.0;
  }

  // To all that agree with the median.
  void Grow() {
    for (int k = 0; k < kMaxGrowths; ++k) {
      std::vector<double> statistics;
      for (std::size_t i = 0; i < count_; ++i) statistics.push_back(Statistic(i));
      double scale = Median(statistics) / ChiSquareQuantile(0.5, kDof);
      if (poses_.noise == PivotNoise::kKnown) scale = std::max(scale, 1.0);
      const double limit = scale * ChiSquareQuantile(1.0 - of_one_, kDof);
      std::vector<bool> agree(count_);
      for (std::size_t i = 0; i < count_; ++i) agree[i] = statistics[i] <= limit;
      if (Kept(agree) < half_ || agree == kept_) return;
      kept_ = agree;
      Solve();
    }
  }

  static std::size_t Kept(const std::vector<bool>& kept) {
    return static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  }

  // Squared sigmas of what the other poses predict less what is measured.
  double Statistic(std::size_t i) const {
    const PivotFit::Row& row = solution_.fit.rows[i];
    const Eigen::Matrix3d covariance =
        kept_[i] ? Eigen::Matrix3d(row.noise - row.prediction) : row.noise + row.prediction;
    return row.error.dot(covariance.inverse() * row.error);
  }

  double PValue(std::size_t i) const {
    const double squared = Statistic(i) / scale_;
    if (!is_by_f_) return ChiSquareTail(squared, kDof);
    const auto dof = static_cast<double>(solution_.fit.degrees_of_freedom);
    if (!kept_[i]) return FisherFTail(squared / kDof, kDof, dof);
    // The pose is in the variance that it is judged by.
    const double others = dof - squared;
    if (!(dof > kDof)) return 1.0;
    if (!(others > 0.0)) return 0.0;
    return FisherFTail(squared / kDof * (dof - kDof) / others, kDof, dof - kDof);
  }

  bool TakeOut() {
    std::vector<std::pair<double, std::size_t>> worst_first;
    for (std::size_t i = 0; i < count_; ++i)
      if (kept_[i] && PValue(i) < of_one_) worst_first.emplace_back(Statistic(i), i);
    std::sort(worst_first.rbegin(), worst_first.rend());
    std::size_t left = Kept(kept_);
    bool any = false;
    for (const auto& [statistic, i] : worst_first) {
      if (left <= half_ || statistic < kFarOff * worst_first[0].first) break;
      kept_[i] = false;
      any = true;
      --left;
    }
    return any;
  }

  // The best of those left out, once each: what goes out again stays out.
  bool TakeBack() {
    std::size_t best = count_;
    double least = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (kept_[i] || came_back_[i]) continue;
      const double statistic = Statistic(i);
      if (best == count_ || statistic < least) best = i, least = statistic;
    }
    if (best == count_ || PValue(best) < of_one_) return false;
    kept_[best] = came_back_[best] = true;
    return true;
  }

  PivotOutlier Describe(std::size_t i) const {
    PivotOutlier outlier;
    outlier.index = i;
    outlier.distance = PivotError(poses_.items[i].world_from_tool, solution_.fit.x).norm();
    outlier.sigmas = std::sqrt(Statistic(i) / scale_);
    outlier.p_value = -std::expm1(static_cast<double>(count_) * std::log1p(-PValue(i)));
    return outlier;
  }

  const PivotPoses& poses_;
  const PivotOptions& options_;
  std::size_t count_, half_;
  double of_one_;  // Sidak's level of one pose
  std::vector<bool> kept_, came_back_;
  PivotSolution solution_;
  bool is_by_f_ = false;
  double scale_ = 1.0;  // of the variances
};

}  // namespace

std::vector<PivotOutlier> FindPivotOutliers(const PivotPoses& poses, const PivotOptions& options) {
  if (poses.items.size() < kFewestPoses) return {};
  return Snooping(poses, options).Run();
}

}  // namespace hexcal
