// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/outliers.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "estimator/quantiles.h"
#include "estimator/robust_start.h"
#include "estimator/start.h"
#include "estimator/subset_fit.h"

namespace hexcal {
namespace {

constexpr std::size_t kFewestPoses = 6;
constexpr int kMaxGrowths = 30;
// What is significant and at least this part of the worst goes out together with it: so far off
// that the worst cannot be the reason.
constexpr double kFarOff = 0.5;

class Snooping {
 public:
  Snooping(const Observations& observations, const std::optional<NoiseLevels>& noise, double alpha)
      : observations_(observations),
        count_(observations.items.size()),
        of_one_(-std::expm1(std::log1p(-alpha) / static_cast<double>(count_))),
        fit_(observations, noise),
        kept_(count_, false),
        came_back_(count_, false) {
    if (count_ < kFewestPoses) {
      kept_.assign(count_, true);
      fit_.StartFrom(FindStart(observations.items), Spread(observations.items));
      return;
    }
    const RobustStart start = FindRobustStart(observations, noise);
    for (const std::size_t i : start.nearest) kept_[i] = true;
    fit_.StartFrom(start.mounts, start.levels);
  }

  OutlierSearch Run() {
    const bool is_searched = count_ >= kFewestPoses;
    if (is_searched) Grow();
    fit_.Fit(kept_, false);
    while (is_searched && (TakeOut() || TakeBack())) fit_.Fit(kept_, false);
    OutlierSearch search;
    search.mounts = fit_.mounts();
    search.levels = fit_.levels();
    for (std::size_t i = 0; i < count_; ++i)
      if (!kept_[i]) search.outliers.push_back(Describe(i));
    return search;
  }

 private:
  // To all that agree with those that agree.
  void Grow() {
    for (int k = 0; k < kMaxGrowths; ++k) {
      fit_.Fit(kept_, true);
      const double limit = fit_.Limit(of_one_);
      std::vector<bool> agree(count_);
      for (std::size_t i = 0; i < count_; ++i) agree[i] = fit_.Test(i, false).statistic <= limit;
      if (Kept(agree) < HalfOfPoses(count_) || agree == kept_) return;
      kept_ = agree;
    }
  }

  static std::size_t Kept(const std::vector<bool>& kept) {
    return static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  }

  bool IsSignificant(std::size_t pose) const { return fit_.Test(pose, true).p_value < of_one_; }

  // The worst of those kept, and what is about as far off.
  bool TakeOut() {
    std::vector<std::pair<double, std::size_t>> worst_first;
    const double at_least = ChiSquareQuantile(1.0 - of_one_, 6.0);
    for (std::size_t i = 0; i < count_; ++i) {
      if (!kept_[i]) continue;
      const double statistic = fit_.Test(i, false).statistic;
      if (statistic > at_least) worst_first.emplace_back(statistic, i);
    }
    std::sort(worst_first.rbegin(), worst_first.rend());
    std::size_t left = Kept(kept_);
    bool any = false;
    for (const auto& [statistic, i] : worst_first) {
      if (left <= HalfOfPoses(count_) || statistic < kFarOff * worst_first[0].first ||
          !IsSignificant(i))
        break;
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
      const double statistic = fit_.Test(i, false).statistic;
      if (best == count_ || statistic < least) best = i, least = statistic;
    }
    if (best == count_ || IsSignificant(best)) return false;
    kept_[best] = came_back_[best] = true;
    return true;
  }

  Outlier Describe(std::size_t i) const {
    const PoseTest test = fit_.Test(i, true);
    Outlier outlier;
    outlier.index = i;
    outlier.label = observations_.items[i].label;
    outlier.residual = test.off.error;
    outlier.position_sigmas = test.off.SigmasOf(0);
    outlier.orientation_sigmas = test.off.SigmasOf(3);
    outlier.statistic = test.statistic;
    outlier.p_value = -std::expm1(static_cast<double>(count_) * std::log1p(-test.p_value));
    outlier.reason = Reason(test.off);
    return outlier;
  }

  // "position 23 sigma off (4.1 mm), most along x of the tool".
  std::string Part(const DeletionError& off, int first) const {
    const Eigen::Array3d e = off.error.segment<3>(first).array();
    const Eigen::Array3d sigma = off.covariance.diagonal().segment<3>(first).array().sqrt();
    Eigen::Index axis;
    (e / sigma).abs().maxCoeff(&axis);
    const double length = e.matrix().norm();
    return first == 0
               ? fmt::format("position {:.3g} sigma off ({:.3g} mm), most along {} of the tool",
                             off.SigmasOf(0),
                             1e3 * length,
                             "xyz"[axis])
               : fmt::format("orientation {:.3g} sigma off ({:.3g} deg), most about {} of the tool",
                             off.SigmasOf(3),
                             length * 180.0 / kPi,
                             "xyz"[axis]);
  }

  // The part that is further off first; the other one where it alone would be too far as well.
  std::string Reason(const DeletionError& off) const {
    const int first = off.SigmasOf(0) >= off.SigmasOf(3) ? 0 : 3, other = 3 - first;
    std::string text = Part(off, first);
    if (ChiSquareTail(std::pow(off.SigmasOf(other), 2), 3.0) < of_one_)
      text += "; " + Part(off, other);
    return text;
  }

  const Observations& observations_;
  std::size_t count_;
  double of_one_;  // Sidak's level of one pose
  SubsetFit fit_;
  std::vector<bool> kept_;
  std::vector<bool> came_back_;
};

}  // namespace

OutlierSearch FindOutliers(const Observations& observations,
                           const std::optional<NoiseLevels>& noise,
                           const OutlierOptions& options) {
  CHECK(options.alpha > 0.0 && options.alpha < 1.0);
  return Snooping(observations, noise, options.alpha).Run();
}

Observations Without(const Observations& observations, const std::vector<Outlier>& outliers) {
  Observations others = observations;
  for (auto outlier = outliers.rbegin(); outlier != outliers.rend(); ++outlier)
    others.items.erase(others.items.begin() + static_cast<std::ptrdiff_t>(outlier->index));
  return others;
}

}  // namespace hexcal
