// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/covariance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hexcal {
namespace {

// Parts of a null direction smaller than this (columns scaled) are rounding.
constexpr double kRoundingShare = 1e-6;
// Parts worth a word.
constexpr double kNamedShare = 0.05;

std::string Vector3Text(const Eigen::Vector3d& v) {
  // Adding zero turns -0 into 0.
  const auto round = [](double x) { return std::round(x * 1e3) / 1e3 + 0.0; };
  return fmt::format("[{} {} {}]", round(v.x()), round(v.y()), round(v.z()));
}

// The parameters that a direction moves, the largest as 1.
std::string PartsText(const Vector12d& direction) {
  const double largest = direction.cwiseAbs().maxCoeff();
  std::string parts;
  for (int i = 0; i < 12; ++i)
    if (std::abs(direction[i]) > kNamedShare * largest)
      parts += fmt::format(
          "{}{} {:+.3f}", parts.empty() ? "" : ", ", kParameters[i].name, direction[i] / largest);
  return parts;
}

// A direction in m and rad, in words.
std::string DescribeDirection(const Vector12d& direction) {
  const Eigen::Vector3d base_shift = direction.segment<3>(0), base_turn = direction.segment<3>(3);
  const Eigen::Vector3d tool_shift = direction.segment<3>(6), tool_turn = direction.segment<3>(9);
  const double shift = std::max(base_shift.norm(), tool_shift.norm());
  const double turn = std::max(base_turn.norm(), tool_turn.norm());
  const std::string parts = PartsText(direction);
  if (turn >= kNamedShare * shift)
    return fmt::format("a turn of base and tool together ({})", parts);
  if (std::min(base_shift.norm(), tool_shift.norm()) <= 0.5 * shift)
    return fmt::format("a shift of base and tool together ({})", parts);
  return fmt::format(
      "a shift of the base along {} of frame base against the tool along {} of frame tool ({})",
      Vector3Text(base_shift.normalized()),
      Vector3Text(tool_shift.normalized()),
      parts);
}

// Why a direction is not determined, and what to do, for the person who must choose the next poses;
// empty where it is.
std::string WhyNull(double singular_value,
                    double largest,
                    const Vector12d& one_sigma,
                    const CovarianceOptions& options) {
  if (!(singular_value > options.smallest_ratio * largest))
    return "it leaves every predicted pose as it is: measure poses with rotations about more than "
           "one axis";
  if (singular_value < 3.0 * options.robot_orientation_noise_rad)
    return "the rotations that tell it are no larger than the robot's orientation noise: measure "
           "poses with larger rotations about more than one axis";
  for (int i = 0; i < 12; ++i) {
    const bool is_angle = kParameters[i].is_angle;
    const double sigma = options.noise_scale * std::abs(one_sigma[i]);
    if (!(sigma <= (is_angle ? options.largest_sigma_rad : options.largest_sigma_m)))
      return fmt::format(
          "the noise leaves {} open by {:.2g} {}: measure poses with larger rotations about more "
          "than one axis, or with less noise",
          kParameters[i].name,
          sigma,
          is_angle ? "rad" : "m");
  }
  return "";
}

}  // namespace

ParameterCovariance ComputeCovariance(const Matrix12d& r_factor, const CovarianceOptions& options) {
  const Information information = Analyse(r_factor);
  const Vector12d s = information.singular_values;

  ParameterCovariance result;
  Observability& observability = result.observability;
  observability.singular_values = s;
  observability.condition_number = s[0] / s[11];
  observability.determined.fill(true);
  for (int k = 0; k < 12; ++k) {
    const Vector12d direction = information.directions.col(k);
    if (const std::string why = WhyNull(s[k], s[0], direction / s[k], options); !why.empty()) {
      ++observability.null_directions;
      observability.weak_directions.push_back(DescribeDirection(direction) + ", since " + why);
      for (int i = 0; i < 12; ++i)
        if (std::abs(information.scaled_directions(i, k)) > kRoundingShare)
          observability.determined[i] = false;
    } else {
      result.covariance += direction * direction.transpose() / (s[k] * s[k]);
    }
  }
  return result;
}

}  // namespace hexcal
