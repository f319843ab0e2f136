// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/discovery.h"

namespace hexcal {

// What is said of a hexapod whose geometry is not published.

// "base radius 2.1 m (1.7 to 2.6), ...", with what kind of statement it is.
std::string GeometrySentence(const GeometryClass& geometry);

// Where the geometry is in the model: the other members of its class, and the map. Else: the class,
// as what the map may stand for. Each with what would decide.
std::vector<Rival> GeometryRivals(const GeometryClass& geometry);

}  // namespace hexcal
