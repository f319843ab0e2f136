// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "estimator/pivot_outliers.h"
#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kProbability = 0.95;
constexpr double kUpper = 0.5 * (1.0 + kProbability);
// Beyond this t is the normal distribution to all digits that matter.
constexpr double kMany = 1e7;
// The noise is a visible part of the tilt: first-order covariances begin to fail.
constexpr double kSmallTiltToNoise = 10.0;

std::string DirectionText(const Eigen::Vector3d& n) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", n.x(), n.y(), n.z());
}

void SetIntervals(PivotResult* result) {
  for (int k = 0; k < 6; ++k)
    result->half_width[k] =
        StudentTQuantile(kUpper, std::min(result->degrees_of_freedom[k], kMany)) *
        std::sqrt(result->covariance(k, k));
  result->tip_ellipsoid =
      3.0 * FisherFQuantile(kProbability, 3.0, std::min(result->tip_degrees_of_freedom, kMany));
  const double dof = result->degrees_of_freedom_of_fit;
  result->chi_square_low = ChiSquareQuantile(1.0 - kUpper, dof);
  result->chi_square_high = ChiSquareQuantile(kUpper, dof);
}

void SetRows(const PivotPoses& poses,
             const std::vector<bool>& used,
             const PivotSolution& solution,
             PivotResult* result) {
  double squares = 0.0;
  for (std::size_t i = 0; i < poses.items.size(); ++i) {
    const PivotPose& pose = poses.items[i];
    const PivotRow row{pose.label,
                       pose.line,
                       used[i],
                       pose.world_from_tool * result->x.tip_in_tool - result->x.pivot_in_world,
                       solution.fit.rows[i].squared_sigmas};
    if (row.used) squares += row.residual.squaredNorm();
    result->rows.push_back(row);
  }
  const auto count = static_cast<double>(std::count(used.begin(), used.end(), true));
  result->rms = std::sqrt(squares / count);
}

std::string RowName(const PivotRow& row) {
  return row.line > 0 ? fmt::format("pose {} (line {})", row.label, row.line)
                      : fmt::format("pose {}", row.label);
}

void WarnOfGeometry(PivotResult* result) {
  constexpr double kDegrees = 180.0 / kPi;
  if (result->lost_count() == 3) {
    result->warnings.push_back(
        fmt::format("the poses do not turn the tool by more than their noise does ({:.2g} deg, "
                    "RMS, of {:.2g}): "
                    "nothing is known of its tip; tilt it about two axes",
                    result->tilts.rms[2] * kDegrees,
                    result->noise_tilts[2] * kDegrees));
    return;
  }
  for (int k = 0; k < 3; ++k) {
    const double tilt = result->tilts.rms[k], noise = result->noise_tilts[k];
    const std::string direction = DirectionText(result->tilts.directions.col(k));
    if (result->is_lost[k])
      result->warnings.push_back(fmt::format(
          "the tip is not determined along {} of frame T, which the poses tilt by {:.2g} deg "
          "(RMS) only, their noise by {:.2g}; its coordinate there is set to zero; tilt the tool "
          "about other axes, too",
          direction,
          tilt * kDegrees,
          noise * kDegrees));
    else if (tilt < kSmallTiltToNoise * noise)
      result->warnings.push_back(
          fmt::format("the poses tilt {} of frame T by only {:.2g} times what their noise does: "
                      "the tip's standard deviation along it is a rough one; tilt the tool further",
                      direction,
                      tilt / noise));
  }
}

void WarnOfFit(PivotResult* result) {
  for (const PivotOutlier& outlier : result->outliers)
    result->warnings.push_back(
        fmt::format("{} {}: it puts the tip {:.3g} mm from where the others have the pivot, {:.3g} "
                    "sigma",
                    RowName(result->rows[outlier.index]),
                    result->rows[outlier.index].used ? "looks like an outlier, but is used"
                                                     : "is left out as an outlier",
                    1e3 * outlier.distance,
                    outlier.sigmas));
  if (!result->converged) result->warnings.emplace_back("the fit did not converge");
  if (!result->NoiseIsStated() || result->lost_count() > 0) return;
  if (result->chi_square > result->chi_square_high)
    result->warnings.push_back(
        fmt::format("what is left over is {:.2f} times what the stated noise explains: the tip "
                    "slipped, the tool bent, or the noise is larger",
                    std::sqrt(result->chi_square / result->degrees_of_freedom_of_fit)));
  else if (result->chi_square < result->chi_square_low)
    result->warnings.push_back(
        fmt::format("what is left over is only {:.2f} of what the stated noise explains",
                    std::sqrt(result->chi_square / result->degrees_of_freedom_of_fit)));
}

}  // namespace

bool PivotResult::IsDetermined(int axis) const {
  // A share of the direction that would show in no digit that matters.
  constexpr double kNoShare = 1e-6;
  for (int k = 0; k < 3; ++k)
    if (is_lost[k] && std::abs(tilts.directions(axis, k)) > kNoShare) return false;
  return true;
}

PivotResult CalibratePivot(const PivotPoses& poses, const PivotOptions& options) {
  CHECK_GE(poses.items.size(), 3u);
  CHECK(options.alpha > 0.0 && options.alpha < 1.0);
  PivotResult result;
  result.outliers = FindPivotOutliers(poses, options);
  std::vector<bool> used(poses.items.size(), true);
  if (options.reject_outliers)
    for (const PivotOutlier& outlier : result.outliers) used[outlier.index] = false;
  const PivotSolution solution = SolvePivot(poses, used, options);
  result.x = solution.fit.x;
  result.covariance = solution.covariance;
  result.degrees_of_freedom = solution.degrees_of_freedom;
  result.tip_degrees_of_freedom = solution.tip_degrees_of_freedom;
  result.tilts = solution.tilts;
  result.condition_number = PivotCondition(solution.tilts);
  result.noise_tilts = solution.noise_tilts;
  result.is_lost = solution.is_lost;
  result.noise = poses.noise;
  result.noise_scale = solution.noise_scale;
  result.position_noise = solution.position_noise;
  result.orientation_noise = solution.orientation_noise;
  result.chi_square = solution.fit.squared_sigmas;
  result.degrees_of_freedom_of_fit = solution.fit.degrees_of_freedom;
  result.iterations = solution.fit.iterations;
  result.converged = solution.fit.converged;
  SetRows(poses, used, solution, &result);
  SetIntervals(&result);
  WarnOfFit(&result);
  WarnOfGeometry(&result);
  return result;
}

}  // namespace hexcal
