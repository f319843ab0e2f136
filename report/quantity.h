// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hexcal {

// Numbers as people read them. UTF-8.

// How a quantity in an SI unit is shown: 1e3 and "mm" for m.
struct DisplayUnit {
  double factor = 1.0;
  std::string name;
};
// unit: SI, as in the table of effects; others are shown as they are.
DisplayUnit DisplayUnitOf(std::string_view unit);

// "0.123 ± 0.004 mm" with two digits of the deviation, "0.1234 mm" where it is not known.
std::string QuantityText(double value, double standard_deviation, std::string_view unit);

// Of m or rad in thousandths, for a column of mm or mrad: four decimals, or three digits of what
// would have none of them; "0" where nothing but rounding is left. A dash for no number.
std::string MilliText(double value);

// Whether a length in m or an angle in rad is nothing but the rounding of the numbers.
bool IsRounding(double value);

// Four digits and a unit that suits the size: 4.2e-5 m is "42 µm". A dash for no number.
std::string SizeText(double value, std::string_view unit);

// "0.03", "4.2e-07", "10^-321" by its logarithm where it is too small for a number.
std::string ProbabilityText(double p, double log10_p);
std::string ProbabilityText(double p);

// "12 %"; a dash for no number.
std::string ShareText(double share);

// k of an expanded uncertainty, of both: "1.960"; a dash where either is no number.
std::string CoverageFactorText(double expanded, double standard);

}  // namespace hexcal
