// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/subset_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "estimator/noise.h"
#include "estimator/normal_matrix.h"
#include "estimator/polish.h"
#include "estimator/quantiles.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 10;
// Expected decrease of half the sum of squares, in squared sigmas, below which a step is none.
constexpr double kSettled = 1e-8;
// Levels below so many roundings of the data are not noise.
constexpr double kRoundings = 64.0;
// The stated noise is disproved where chance alone leaves as much with this probability.
constexpr double kDisproved = 1e-4;
// What is left of a level's evidence without one pose, at the least.
constexpr double kSmallestRest = 0.01;

// By how much the mean square of the nearest share of Gaussian errors, six-dimensional, is less
// than that of all. P. J. Rousseeuw, K. Van Driessen (2006), sec. 3.
double NearestVariance(double share) {
  if (share >= 1.0) return 1.0;
  return (1.0 - ChiSquareTail(ChiSquareQuantile(share, 6.0), 8.0)) / share;
}

Observations Only(const Observations& all, const std::vector<bool>& kept) {
  Observations some;
  some.tool_noise_is_known = all.tool_noise_is_known;
  some.has_robot_noise = all.has_robot_noise;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) some.items.push_back(all.items[i]);
  return some;
}

}  // namespace

SubsetFit::SubsetFit(const Observations& observations, const std::optional<NoiseLevels>& noise)
    : observations_(observations),
      rounding_(Rounding(observations.items)),
      levels_estimated_(!noise && !observations.tool_noise_is_known),
      levels_(noise.value_or(NoiseLevels{})) {
  if (levels_estimated_) basis_ = NoiseBasis::kTwoLevels;
}

void SubsetFit::StartFrom(const BaseAndTool& mounts, const NoiseLevels& levels) {
  mounts_ = mounts;
  if (levels_estimated_) levels_ = levels;
}

void SubsetFit::Fit(const std::vector<bool>& kept, bool is_nearest) {
  kept_ = kept;
  scale_ = 1.0;
  const Observations some = Only(observations_, kept);
  Iterate(some);
  const double share = static_cast<double>(some.items.size()) / static_cast<double>(kept.size());
  SetFreedom(some, is_nearest ? NearestVariance(share) : 1.0);
}

void SubsetFit::Iterate(const Observations& kept) {
  for (int k = 0; k < kMaxSteps; ++k) {
    if (levels_estimated_) levels_ = EstimateNoise(kept, mounts_, levels_);
    std::vector<Matrix6d> whiteners;
    whiteners.reserve(kept.items.size());
    for (const Observation& o : kept.items) whiteners.push_back(WhitenerOf(NoiseOf(o)));
    const WeightedStep step = StepFrom(kept.items, whiteners, mounts_);
    mounts_ = Moved(mounts_, step.y);
    if (!(step.decrease > kSettled)) break;
  }
  levels_.position = std::max(levels_.position, kRoundings * rounding_.position);
  levels_.orientation = std::max(levels_.orientation, kRoundings * rounding_.orientation);
}

// The covariance of the fit, and how much of the residuals' freedom it leaves: to all, and, by the
// trace of each part's block, to positions and orientations.
void SubsetFit::SetFreedom(const Observations& kept, double variance_share) {
  if (levels_estimated_) {
    levels_.position /= std::sqrt(variance_share);
    levels_.orientation /= std::sqrt(variance_share);
  }
  Matrix12d normal = Matrix12d::Zero();
  double squared = 0.0;
  for (const Observation& o : kept.items) {
    const LinearisedError e = Linearise(o, mounts_);
    const Matrix6d whitener = WhitenerOf(NoiseOf(o));
    const Matrix6x12d j = whitener * e.jacobian;
    normal.noalias() += j.transpose() * j;
    squared += (whitener * e.error).squaredNorm();
  }
  covariance_ = InverseOfNormal(normal);
  position_freedom_ = turn_freedom_ = 3.0 * static_cast<double>(kept.items.size());
  for (const Observation& o : kept.items) {
    const Matrix6x12d j = WhitenerOf(NoiseOf(o)) * Linearise(o, mounts_).jacobian;
    const Vector6d taken = (j * covariance_).cwiseProduct(j).rowwise().sum();
    position_freedom_ -= taken.head<3>().sum();
    turn_freedom_ -= taken.tail<3>().sum();
  }
  freedom_ = position_freedom_ + turn_freedom_;
  if (levels_estimated_) return;
  basis_ = NoiseBasis::kStated;
  const double of_noise = squared / variance_share;
  if (!(freedom_ > 0) || ChiSquareTail(of_noise, freedom_) > kDisproved) return;
  basis_ = NoiseBasis::kScaled;
  scale_ = std::sqrt(of_noise / freedom_);
  covariance_ *= scale_ * scale_;
}

Matrix6d SubsetFit::NoiseOf(const Observation& o) const {
  return ErrorCovariance(o, observations_, mounts_.platform_from_tool, levels_);
}

PoseTest SubsetFit::Test(std::size_t pose, bool with_p_value) const {
  const Observation& o = observations_.items[pose];
  const bool in_fit = kept_[pose];
  const auto off =
      ErrorAgainstOthers(Linearise(o, mounts_), scale_ * scale_ * NoiseOf(o), covariance_, in_fit);
  PoseTest test;
  if (!off) return test;
  test.off = *off;
  // Without the pose less is left over, and the noise found is smaller.
  const auto rest = [](double freedom, double of_pose, int rows) {
    return std::max(freedom - of_pose, kSmallestRest * freedom) / (freedom - rows);
  };
  if (in_fit && basis_ == NoiseBasis::kTwoLevels) {
    if (!(std::min(position_freedom_, turn_freedom_) > 3.0)) return {};
    test.off.error.head<3>() /=
        std::sqrt(rest(position_freedom_, std::pow(off->SigmasOf(0), 2), 3));
    test.off.error.tail<3>() /= std::sqrt(rest(turn_freedom_, std::pow(off->SigmasOf(3), 2), 3));
  }
  if (in_fit && basis_ == NoiseBasis::kScaled) {
    if (!(freedom_ > 6.0)) return {};
    test.off.error /= std::sqrt(rest(freedom_, off->Squared(), 6));
  }
  test.statistic = test.off.Squared();
  if (with_p_value) test.p_value = Tail(test.statistic, in_fit);
  return test;
}

double SubsetFit::Tail(double statistic, bool in_fit) const {
  if (basis_ == NoiseBasis::kStated) return ChiSquareTail(statistic, 6.0);
  if (basis_ == NoiseBasis::kScaled)
    return FisherFTail(statistic / 6.0, 6.0, freedom_ - (in_fit ? 6.0 : 0.0));
  const double gone = in_fit ? 3.0 : 0.0;
  return FisherSumTail(statistic, 3.0, position_freedom_ - gone, turn_freedom_ - gone);
}

double SubsetFit::Limit(double probability) const {
  if (basis_ == NoiseBasis::kStated) return ChiSquareQuantile(1.0 - probability, 6.0);
  const double freedom =
      basis_ == NoiseBasis::kScaled ? freedom_ : std::min(position_freedom_, turn_freedom_);
  return freedom > 0.0 ? 6.0 * FisherFQuantile(1.0 - probability, 6.0, freedom)
                       : std::numeric_limits<double>::infinity();
}

}  // namespace hexcal
