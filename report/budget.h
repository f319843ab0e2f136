// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// The uncertainty budget of a point at a place (JCGM 100, clause 8): of lengths, as root mean
// squares over all directions, so that a contribution's square is the trace of its covariance.

enum class BudgetQuantity { kLength, kPosition, kOrientation };
std::string_view NameOf(BudgetQuantity quantity);  // length, position, orientation

// normal: the value is a standard deviation, divisor 1; rectangular: a half width, divisor sqrt 3;
// t: a standard deviation that few observations told, divisor 1.
enum class BudgetSpread { kNormal, kRectangular, kStudent };
std::string_view NameOf(BudgetSpread spread);  // normal, rectangular, t

// contribution = sensitivity * value / divisor.
struct BudgetRow {
  std::string name;
  std::string origin;  // where its value is from
  char type = 'B';     // of evaluation (JCGM 100)
  BudgetQuantity quantity = BudgetQuantity::kLength;
  double value = 0.0;  // of each coordinate, m or rad; kLength: of the length
  BudgetSpread spread = BudgetSpread::kNormal;
  double divisor = 1.0;
  double sensitivity = 1.0;   // m/m or m/rad
  double contribution = 0.0;  // RMS length, m
  double share = 0.0;         // of the variance
  double degrees_of_freedom = 0.0;
};

// A number of the calibration: contribution = sensitivity * value, its standard uncertainty.
struct ParameterRow {
  std::string name;
  std::string unit;  // SI
  double value = 0.0;
  double sensitivity = 0.0;   // m per unit
  double contribution = 0.0;  // m
  double share = 0.0;         // of the calibration's variance; all with correlations make 1
  double degrees_of_freedom = 0.0;
};

std::string LabelOf(const BudgetRow& row);  // "robot's own error: position"

struct Budget {
  std::vector<BudgetRow> rows;
  // The calibration's own: the numbers as if they were independent, and what their correlations
  // add to that, or take from it, of its variance (JCGM 100, 5.2.2).
  std::vector<ParameterRow> parameters;
  double correlations = 0.0;
};

}  // namespace hexcal
