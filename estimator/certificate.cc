// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/certificate.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/chordal_optimum.h"
#include "estimator/estimate.h"
#include "estimator/noise.h"

namespace hexcal {
namespace {

// Deviations from one variance for all axes, as a part of it, that are rounding.
constexpr double kIsotropic = 1e-9;
// Standard deviations. Other weights move a solution by a few; another optimum is far away.
constexpr double kSameOptimum = 10.0;
// Differences below this, rad and parts of the poses' spread, are rounding.
constexpr double kNoDifference = 1e-10;

bool IsIsotropic(const Matrix6d& covariance) {
  Matrix6d rest = covariance;
  const double position = rest.diagonal().head<3>().mean();
  const double orientation = rest.diagonal().tail<3>().mean();
  rest.diagonal().head<3>().array() -= position;
  rest.diagonal().tail<3>().array() -= orientation;
  return rest.topLeftCorner<3, 3>().cwiseAbs().maxCoeff() <= kIsotropic * position &&
         rest.bottomRightCorner<3, 3>().cwiseAbs().maxCoeff() <= kIsotropic * orientation &&
         rest.topRightCorner<3, 3>().cwiseAbs().maxCoeff() <=
             kIsotropic * std::sqrt(position * orientation);
}

// The problem with one weight each, and whether it is the estimate's own.
struct OneWeightEach {
  ChordalCost cost;
  bool exact = true;
  double chi_square = 0.0;  // of the solution, its angles as they are
};

OneWeightEach Simplify(const Observations& observations,
                       const NoiseLevels& levels,
                       const Estimate& estimate) {
  CHECK_EQ(observations.items.size(), estimate.poses.size());
  OneWeightEach problem;
  const Pose3d& tool = estimate.mounts.platform_from_tool;
  const bool common = HasCommonCovariance(observations);
  Matrix6d c = ErrorCovariance(observations.items[0], observations, tool, levels);
  bool isotropic = IsIsotropic(c);
  for (std::size_t i = 0; i < observations.items.size(); ++i) {
    const Observation& o = observations.items[i];
    const double weight = estimate.poses[i].weight;
    if (!(weight > 0)) continue;
    if (!common) {
      c = ErrorCovariance(o, observations, tool, levels);
      isotropic = IsIsotropic(c);
    }
    problem.exact = problem.exact && weight == 1.0 && isotropic;
    const double position = weight / c.diagonal().head<3>().mean();
    const double orientation = weight / c.diagonal().tail<3>().mean();
    problem.cost.Add(o, position, orientation);
    const Vector6d& e = estimate.poses[i].residual;
    problem.chi_square +=
        position * e.head<3>().squaredNorm() + orientation * e.tail<3>().squaredNorm();
  }
  return problem;
}

double Distance(const BaseAndTool& optimum,
                const Observations& observations,
                const Estimate& estimate) {
  const double size =
      Spread(observations.items).position + estimate.mounts.platform_from_tool.translation.norm();
  Vector12d difference;
  difference << Minus(optimum.world_from_base, estimate.mounts.world_from_base),
      Minus(optimum.platform_from_tool, estimate.mounts.platform_from_tool);
  double largest = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double rounding = kNoDifference * (kParameters[i].is_angle ? 1.0 : size);
    if (estimate.observability.determined[i] && std::abs(difference[i]) > rounding)
      largest = std::max(largest, std::abs(difference[i]) / std::sqrt(estimate.covariance(i, i)));
  }
  return largest;
}

std::string WhyNot(const ChordalOptimum& optimum, const Certificate& c, const Estimate& estimate) {
  if (!estimate.converged) return "the solver did not converge";
  if (estimate.observability.null_directions > 0)
    return "there is more than one best solution: the data do not determine " +
           estimate.observability.weak_directions[0];
  if (!optimum.is_stationary) return "the descent to the optimum with one weight each did not end";
  if (!optimum.is_best)
    return fmt::format(
        "another base and tool might leave up to {:.3g} of the sum of squares less: a local "
        "minimum, or more noise than the proof can bear",
        optimum.gap);
  if (!optimum.is_unique) return "there is more than one best solution";
  if (!(c.distance <= kSameOptimum))
    return fmt::format(
        "the best base and tool with one weight for coordinates and one for angles are {:.3g} "
        "standard deviations away",
        c.distance);
  return "";
}

}  // namespace

Certificate Certify(const Observations& observations,
                    const NoiseLevels& levels,
                    const Estimate& estimate) {
  const OneWeightEach problem = Simplify(observations, levels, estimate);
  const ChordalOptimum optimum = FindChordalOptimum(problem.cost, estimate.mounts);
  Certificate certificate;
  certificate.smallest_eigenvalue = optimum.smallest_eigenvalue;
  certificate.exact = problem.exact;
  certificate.distance = Distance(optimum.mounts, observations, estimate);
  // 4 sin^2(angle / 2) is never more than the angle squared: the bound holds for angles, too.
  certificate.gap = problem.exact ? std::max(0.0, problem.chi_square - optimum.lower_bound) /
                                        std::max(problem.chi_square, optimum.rounding)
                                  : optimum.gap;
  certificate.why = WhyNot(optimum, certificate, estimate);
  certificate.certified = certificate.why.empty();
  if (certificate.certified)
    certificate.why =
        problem.exact
            ? "no base and tool anywhere leave a smaller sum of squares"
            : fmt::format(
                  "no base and tool anywhere leave a smaller sum of squares with one weight for "
                  "coordinates and one for angles; the weights of the solution are not of that "
                  "kind, and move it by {:.2g} standard deviations",
                  certificate.distance);
  return certificate;
}

NoiseLevels LevelsOf(const Observations& observations,
                     const std::optional<NoiseLevels>& given,
                     const Estimate& estimate) {
  if (observations.tool_noise_is_known) return {};
  if (given) return *given;
  const NoiseLevels levels{estimate.noise.position, estimate.noise.orientation};
  if (!observations.has_robot_noise) return levels;
  return EstimateNoise(observations, estimate.mounts, levels);
}

}  // namespace hexcal
