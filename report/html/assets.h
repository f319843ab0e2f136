// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// Texts embedded when hexcal was built (cmake/hexcal_charts.cmake), the same in every report.
std::string_view PageCss();
std::string_view PageScript();

// plotly.js (MIT), for flat charts and for those in space. Empty where it could not be fetched.
std::string_view FlatCharts();
std::string_view SpaceCharts();

}  // namespace hexcal
