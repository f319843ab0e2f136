// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "discovery/discovery.h"
#include "measurement/dataset.h"

namespace hexcal::testing {

// A discovery written by hand, every number another one: leg 3's gain, which a radius could also
// be, then an offset of the tool's second marker, which nothing else could; 24 poses.
Discovery MakeDiscovery();

// A dataset of its poses, one a minute.
Dataset DatasetOf(const Discovery& discovery);

}  // namespace hexcal::testing
