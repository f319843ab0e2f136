// SPDX-License-Identifier: BSD-3-Clause
#include "report/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hexcal {
namespace {

// Of a length in m or an angle below this, nothing but the rounding of the numbers is left.
constexpr double kRounding = 1e-13;
constexpr std::string_view kNone = "–";

struct Row {
  std::string_view unit;
  double factor;
  std::string_view name;
};

constexpr Row kRows[] = {
    {"m", 1e3, "mm"},
    {"rad", 1e3, "mrad"},
    {"phase", 57.29577951308232, "°"},
    {"1", 1e6, "ppm"},
    {"1/m", 1.0, "µm/mm²"},
    {"m/rad", 1e3, "mm/rad"},
    {"m/N", 1e6, "µm/N"},
    {"1/K", 1e6, "ppm/K"},
    {"m/K", 1e6, "µm/K"},
    {"rad/K", 1e6, "µrad/K"},
    {"rad/(N m)", 1e6, "µrad/(N m)"},
    {"1/m^2", 1.0, "1/m²"},
};

// "-0" is said of nothing.
std::string WithoutSignOfZero(std::string number) {
  return number.find_first_not_of("-0.") == std::string::npos && number[0] == '-' ? number.substr(1)
                                                                                  : number;
}

std::string WithUnit(const std::string& number, std::string_view unit) {
  return unit.empty() ? number : fmt::format("{} {}", number, unit);
}

}  // namespace

DisplayUnit DisplayUnitOf(std::string_view unit) {
  for (const Row& row : kRows)
    if (row.unit == unit) return {row.factor, std::string(row.name)};
  return {1.0, std::string(unit)};
}

std::string QuantityText(double value, double standard_deviation, std::string_view unit) {
  const DisplayUnit display = DisplayUnitOf(unit);
  if (!std::isfinite(value)) return std::string(kNone);
  if (!(standard_deviation > 0) || !std::isfinite(standard_deviation))
    return WithUnit(fmt::format("{:.4g}", display.factor * value), display.name);
  const double sigma = display.factor * standard_deviation;
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 9);
  return WithUnit(
      fmt::format("{} ± {:.{}f}",
                  WithoutSignOfZero(fmt::format("{:.{}f}", display.factor * value, decimals)),
                  sigma,
                  decimals),
      display.name);
}

bool IsRounding(double value) { return std::abs(value) < kRounding; }

std::string MilliText(double value) {
  constexpr double kFourDecimals = 1e-6;  // two digits of them or more
  if (!std::isfinite(value)) return std::string(kNone);
  if (std::abs(value) >= kFourDecimals) return fmt::format("{:.4f}", 1e3 * value);
  return IsRounding(value) ? "0" : fmt::format("{:.3g}", 1e3 * value);
}

std::string SizeText(double value, std::string_view unit) {
  if (!std::isfinite(value)) return std::string(kNone);
  if ((unit == "m" || unit == "rad") && IsRounding(value)) value = 0.0;
  if (unit == "m" && std::abs(value) < 1e-4) return fmt::format("{:.3g} µm", 1e6 * value);
  if (unit == "rad" && std::abs(value) < 1e-4) return fmt::format("{:.3g} µrad", 1e6 * value);
  const DisplayUnit display = DisplayUnitOf(unit);
  return WithUnit(fmt::format("{:.4g}", display.factor * value), display.name);
}

std::string ProbabilityText(double p, double log10_p) {
  if (!std::isfinite(p)) return std::string(kNone);
  if (p > 0.0) return fmt::format("{:.2g}", p);
  if (std::isfinite(log10_p) && log10_p < 0.0) return fmt::format("10^{:.0f}", log10_p);
  return "0";
}

std::string ProbabilityText(double p) { return ProbabilityText(p, 0.0); }

std::string ShareText(double share) {
  if (!std::isfinite(share)) return std::string(kNone);
  constexpr double kNothing = 1e-9;  // of a whole, in any budget
  if (std::abs(share) < kNothing) return "0 %";
  return fmt::format("{:.3g} %", 100.0 * share);
}

std::string CoverageFactorText(double expanded, double standard) {
  const double factor = expanded / standard;
  return std::isfinite(factor) ? fmt::format("{:.3f}", factor) : std::string(kNone);
}

}  // namespace hexcal
