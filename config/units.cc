// SPDX-License-Identifier: BSD-3-Clause
#include "config/units.h"

#include <algorithm>
#include <array>

namespace hexcal {
namespace {

constexpr double kDegree = kPi / 180;

constexpr std::array<Unit, 2> kLengthUnits = {{{"m", "m", 1.0}, {"mm", "m", 1e-3}}};
constexpr std::array<Unit, 2> kAngleUnits = {{{"rad", "rad", 1.0}, {"deg", "rad", kDegree}}};

// K is a difference or an absolute temperature as the file means it; it is not turned into degC.
constexpr std::array<Unit, 16> kCovariateUnits = {{
    {"s", "s", 1.0},
    {"min", "s", 60.0},
    {"h", "s", 3600.0},
    {"degC", "degC", 1.0},
    {"K", "K", 1.0},
    {"kg", "kg", 1.0},
    {"N", "N", 1.0},
    {"m", "m", 1.0},
    {"mm", "m", 1e-3},
    {"m/s", "m/s", 1.0},
    {"mm/s", "m/s", 1e-3},
    {"rad", "rad", 1.0},
    {"deg", "rad", kDegree},
    {"rad/s", "rad/s", 1.0},
    {"deg/s", "rad/s", kDegree},
    {"1", "1", 1.0},
}};

template <std::size_t kSize>
std::optional<Unit> Find(const std::array<Unit, kSize>& units, std::string_view symbol) {
  const auto unit = std::find_if(
      units.begin(), units.end(), [&](const Unit& known) { return known.symbol == symbol; });
  if (unit == units.end()) return std::nullopt;
  return *unit;
}

}  // namespace

std::optional<Unit> FindLengthUnit(std::string_view symbol) { return Find(kLengthUnits, symbol); }

std::optional<Unit> FindAngleUnit(std::string_view symbol) { return Find(kAngleUnits, symbol); }

std::optional<Unit> FindCovariateUnit(std::string_view symbol) {
  return Find(kCovariateUnits, symbol);
}

}  // namespace hexcal
