// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hexcal {

// "hexcal 0.1.0" and the libraries it was built with, a line each.
std::string VersionText();

}  // namespace hexcal
