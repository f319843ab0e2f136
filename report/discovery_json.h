// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/discover.h"

namespace hexcal {

// discovery.json (docs/results.md), format hexcal/discovery/1: no times, SI units. What is not
// known is null.
std::string DiscoveryJson(const std::string& dataset,
                          const DiscoverOptions& options,
                          const Discovery& discovery);

// The same object on one line.
std::string DiscoveryJsonLine(const std::string& dataset,
                              const DiscoverOptions& options,
                              const Discovery& discovery);

}  // namespace hexcal
