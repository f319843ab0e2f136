// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "config/strict_yaml.h"
#include "config/units.h"
#include "measurement/dataset.h"

namespace hexcal {

inline constexpr std::array<std::string_view, 2> kBodyNames = {"base", "tool"};  // by BodyId

// The mapping under bodies:, both bodies of it; the base's may be missing, and has no markers then,
// unless needs_base. InputError for fewer than three markers, for
// markers of one name or in one place, for known coordinates on one line, and for an x_axis that is
// not two markers of a centroid body.
std::array<MarkerBody, 2> ReadMarkerBodies(const YamlNode& node,
                                           const Units& units,
                                           bool needs_base = true);

}  // namespace hexcal
