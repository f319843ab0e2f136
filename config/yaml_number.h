// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hexcal {

// The shortest text that reads back to the same bits, and that readers of YAML 1.1 take for a
// number too: 3.0e-05, where 3e-05 is text to them. Finite values.
std::string YamlNumber(double value);

// "[1, 2.5, 3.0e-05]".
std::string YamlNumbers(const double* values, int size);

}  // namespace hexcal
