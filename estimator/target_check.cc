// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/target_check.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kDigits = 2;
constexpr double kCoverageFactor = 2.0;

// One draw of a source's six numbers.
Vector6d Draw(const ErrorSource& source, std::mt19937_64* rng) {
  std::normal_distribution<double> normal;
  // of variance one
  std::uniform_real_distribution<double> uniform(-std::sqrt(3.0), std::sqrt(3.0));
  Vector6d step;
  if (source.covariance_in_tool) {
    // Symmetric and not negative, but perhaps of less than full rank: by its eigenvectors.
    const Eigenvalues eigen = DecomposeSymmetric(*source.covariance_in_tool);
    step.setZero();
    for (int i = 0; i < 3; ++i)
      step.head<3>() +=
          std::sqrt(std::max(eigen.values[i], 0.0)) * normal(*rng) * eigen.vectors.col(i);
    return step;
  }
  for (int i = 0; i < 6; ++i)
    step[i] = (i < 3 ? source.position : source.orientation) *
              (source.spread == Spread1d::kNormal ? normal(*rng) : uniform(*rng));
  return step;
}

// Where the point is, had these small motions been.
struct Motion {
  Vector6d platform = Vector6d::Zero(), tool = Vector6d::Zero(), world = Vector6d::Zero();
  Eigen::Vector3d point = Eigen::Vector3d::Zero(), point_in_tool = Eigen::Vector3d::Zero();

  void Add(SourceSite site, const Vector6d& step) {
    if (site == SourceSite::kPlatform) platform += step;
    if (site == SourceSite::kTool) tool += step;
    if (site == SourceSite::kWorld) world += step;
    if (site == SourceSite::kPoint) point += step.head<3>();
    if (site == SourceSite::kPointInTool) point_in_tool += step.head<3>();
  }
  Eigen::Vector3d Moved(const GrownTarget::Chain& chain, const Eigen::Vector3d& p) const {
    return Plus(Pose3d{}, world) *
               (chain.mounts.world_from_base * Plus(chain.base_from_platform, platform) *
                Plus(chain.mounts.platform_from_tool, tool) * Eigen::Vector3d(p + point_in_tool)) +
           point;
  }
};

// As the machine is with its parameters this much off.
std::optional<GrownTarget::Chain> ChainOff(const BaseAndTool& mounts,
                                           const GrownTarget* grown,
                                           const Pose3d& pose,
                                           const Eigen::VectorXd& step) {
  if (grown != nullptr) return grown->ChainAt(pose, GrownTarget::kNoRow, step);
  return GrownTarget::Chain{{Plus(mounts.world_from_base, Vector6d(step.head<6>())),
                             Plus(mounts.platform_from_tool, Vector6d(step.tail<6>()))},
                            pose};
}

double At(const std::vector<double>& sorted, double share) {
  const double last = static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(std::clamp(share, 0.0, 1.0) * last))];
}

// With which the length there is known, at most as the residuals confirm it.
double FreedomAt(const Estimate& estimate,
                 const std::vector<ErrorSource>& sources,
                 const std::shared_ptr<const GrownTarget>& grown,
                 const Pose3d& base_from_platform,
                 const Eigen::Vector3d& p_in_tool) {
  return std::min(
      TargetError(estimate, sources, grown).At(base_from_platform, p_in_tool).degrees_of_freedom,
      static_cast<double>(estimate.degrees_of_freedom));
}

// Of a length that is known with so many degrees of freedom (JCGM 100:2008, E.4.3).
double RelativeVariance(double degrees_of_freedom) { return 0.5 / degrees_of_freedom; }

bool ExceedsStated(const TargetCheck& check, const StatedLength& stated, double of_repeated) {
  if (!(stated.length > 0.0)) return false;
  const double bent =
      check.agrees ? 0.0 : std::abs(check.repeated_quantile - check.quantile) / check.quantile;
  const double relative = std::sqrt(RelativeVariance(stated.degrees_of_freedom) +
                                    RelativeVariance(of_repeated) + bent * bent);
  return check.repeated_quantile - check.tolerance - 2.0 * check.standard_error >
         stated.length * (1.0 + kCoverageFactor * relative);
}

}  // namespace

TargetCheck CheckTarget(const Estimate& estimate,
                        const std::vector<ErrorSource>& sources,
                        const PropagationCheck& propagation,
                        const Pose3d& base_from_platform,
                        const Eigen::Vector3d& p_in_tool,
                        double probability,
                        std::uint64_t seed,
                        const std::shared_ptr<const GrownTarget>& grown,
                        const StatedLength& stated) {
  CHECK_GT(propagation.estimates.cols(), 0) << "the draws were not kept";
  Estimate known = estimate;
  known.covariance = estimate.covariance_unscaled;
  known.intervals = IntervalsOfKnownNoise(known.covariance);
  std::vector<ErrorSource> of_known = sources;
  for (ErrorSource& source : of_known)
    source.degrees_of_freedom = std::numeric_limits<double>::infinity();
  const auto known_grown =
      grown ? std::make_shared<const GrownTarget>(grown->OfKnownNoise()) : nullptr;
  const TargetCovariance first_order =
      TargetError(known, of_known, known_grown).At(base_from_platform, p_in_tool);
  GrownTarget::Chain real = {estimate.mounts, base_from_platform};
  if (grown) {
    const auto at = grown->At(base_from_platform, GrownTarget::kNoRow);
    CHECK(at) << "a place out of the legs' reach";
    real = at->chain;
  }

  std::mt19937_64 rng(seed);
  std::vector<double> lengths;
  double squares = 0.0;
  for (Eigen::Index k = 0; k < propagation.estimates.cols(); ++k) {
    const auto found =
        ChainOff(estimate.mounts, grown.get(), base_from_platform, propagation.estimates.col(k));
    if (!found) continue;
    Motion motion;
    for (const ErrorSource& source : sources) motion.Add(source.site, Draw(source, &rng));
    const Eigen::Vector3d predicted = found->mounts.world_from_base * found->base_from_platform *
                                      found->mounts.platform_from_tool * p_in_tool;
    lengths.push_back((predicted - motion.Moved(real, p_in_tool)).norm());
    squares += lengths.back() * lengths.back();
  }
  std::sort(lengths.begin(), lengths.end());
  const double n = static_cast<double>(lengths.size());

  TargetCheck check;
  check.draws = static_cast<int>(lengths.size());
  check.rms = first_order.Rms();
  check.quantile = first_order.Quantile(probability);
  check.repeated_rms = std::sqrt(squares / n);
  check.repeated_quantile = At(lengths, probability);
  const auto count_to = [&](double length) {
    return static_cast<int>(std::upper_bound(lengths.begin(), lengths.end(), length) -
                            lengths.begin());
  };
  check.inside = count_to(check.quantile);
  check.inside_stated = count_to(stated.length);
  // By the order statistics two standard errors of a count to either side.
  const double counts = 2.0 * std::sqrt(probability * (1.0 - probability) / n);
  check.standard_error =
      0.25 * (At(lengths, probability + counts) - At(lengths, probability - counts));
  check.tolerance = NumericalTolerance(check.rms, kDigits);
  check.agrees = std::abs(check.quantile - check.repeated_quantile) <=
                 check.tolerance + 2.0 * check.standard_error;
  check.exceeds_stated = ExceedsStated(
      check, stated, FreedomAt(estimate, sources, grown, base_from_platform, p_in_tool));
  return check;
}

}  // namespace hexcal
