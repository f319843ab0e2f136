// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/discovery.h"

namespace hexcal {

// The discovery for the terminal: verdict, what was found with its size, the gap before and after,
// the noise, what could not be tested and what is too small to be seen. UTF-8.
std::string DiscoveryTable(const std::string& dataset, const Discovery& discovery);

}  // namespace hexcal
