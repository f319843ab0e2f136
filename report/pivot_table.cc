// SPDX-License-Identifier: BSD-3-Clause
#include "report/pivot_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"

namespace hexcal {
namespace {

constexpr double kDegrees = 180.0 / kPi;

// As many decimals, in mm, as two digits of sigma need.
int Decimals(double sigma_mm) {
  if (!(sigma_mm > 0) || !std::isfinite(sigma_mm)) return 6;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma_mm))), 1, 9);
}

std::string Point(const PivotResult& result, const Eigen::Vector3d& p, int first) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    const int row = first + k;
    const double sigma = 1e3 * std::sqrt(result.covariance(row, row));
    const bool is_determined = first == 0 ? result.IsDetermined(k) : result.lost_count() == 0;
    text += fmt::format("  {:<15}{} ",
                        k > 0        ? ""
                        : first == 0 ? "tip in T"
                                     : "pivot in W",
                        "xyz"[k]);
    text += is_determined ? fmt::format("{:>14.{}f} mm ± {:.{}f}  (95 %: ± {:.{}f})\n",
                                        1e3 * p[k],
                                        Decimals(sigma),
                                        sigma,
                                        Decimals(sigma),
                                        1e3 * result.half_width[row],
                                        Decimals(sigma))
                          : fmt::format("{:>14.3f} mm   undetermined\n", 1e3 * p[k]);
  }
  return text;
}

std::string Noise(const PivotResult& result) {
  switch (result.noise) {
    case PivotNoise::kKnown:
      return "as stated";
    case PivotNoise::kUpToScale:
      return fmt::format("{:.4g} mm a marker's coordinate, estimated", 1e3 * result.noise_scale);
    case PivotNoise::kUnknown:
      break;
  }
  return fmt::format("{:.4g} mm and {:.4g} mrad a coordinate, estimated",
                     1e3 * result.position_noise,
                     1e3 * result.orientation_noise);
}

std::string ChiSquare(const PivotResult& result) {
  const std::string value = fmt::format(
      "{:.5g} with {} degrees of freedom", result.chi_square, result.degrees_of_freedom_of_fit);
  if (!result.NoiseIsStated()) return value + ": the noise is estimated from it";
  if (result.lost_count() > 0) return value;
  const bool agrees =
      result.chi_square >= result.chi_square_low && result.chi_square <= result.chi_square_high;
  return fmt::format("{}, {} {:.4g} to {:.4g}",
                     value,
                     agrees ? "within" : "outside",
                     result.chi_square_low,
                     result.chi_square_high);
}

}  // namespace

std::string PivotTable(const std::string& dataset, const PivotResult& result) {
  const auto used = std::count_if(
      result.rows.begin(), result.rows.end(), [](const PivotRow& row) { return row.used; });
  std::string text = fmt::format("{}: tool tip from {} poses{}\n\n",
                                 dataset,
                                 used,
                                 used < static_cast<long>(result.rows.size())
                                     ? fmt::format(", {} left out", result.rows.size() - used)
                                     : "");
  text += Point(result, result.x.tip_in_tool, 0);
  text += Point(result, result.x.pivot_in_world, 3);
  text += fmt::format("  {:<15}{:.4g} mm RMS\n", "left over", 1e3 * result.rms);
  text += fmt::format("  {:<15}{}\n", "noise", Noise(result));
  text += fmt::format("  {:<15}{}\n", "chi-square", ChiSquare(result));
  text +=
      fmt::format("  {:<15}{:.3g}, {:.3g} and {:.3g} deg RMS in three directions (noise: {:.2g})\n",
                  "tilts",
                  kDegrees * result.tilts.rms[0],
                  kDegrees * result.tilts.rms[1],
                  kDegrees * result.tilts.rms[2],
                  kDegrees * result.noise_tilts[0]);
  text += fmt::format("  {:<15}{} of [R -1]\n",
                      "condition",
                      std::isfinite(result.condition_number)
                          ? fmt::format("{:.3g}", result.condition_number)
                          : "infinite");
  return text;
}

}  // namespace hexcal
