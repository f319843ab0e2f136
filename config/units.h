// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

namespace hexcal {

inline constexpr double kPi = 3.14159265358979323846;

// A unit that a dataset may declare: value in SI = factor * value. Temperatures stay in degC.
struct Unit {
  std::string_view symbol;     // as written in files
  std::string_view si_symbol;  // what it becomes
  double factor;
};

std::optional<Unit> FindLengthUnit(std::string_view symbol);  // m | mm
std::optional<Unit> FindAngleUnit(std::string_view symbol);   // rad | deg
std::optional<Unit> FindCovariateUnit(
    std::string_view symbol);  // s min h degC K kg N m mm m/s mm/s ...

// The units in which a file states its lengths and angles.
struct Units {
  double length = 1.0;  // m per unit
  double angle = 1.0;   // rad per unit
};

}  // namespace hexcal
