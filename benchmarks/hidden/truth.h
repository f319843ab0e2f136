// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hidden/hidden_effect.h"
#include "hidden/scene.h"

namespace hexcal::hidden {

// What the tracker reads in one row: x, y, z of the base body's four markers, then of the tool's.
using Reading = Eigen::Matrix<double, 24, 1>;

// Where the platform is. std::runtime_error where the legs do not close.
Motion TruePlatform(const Scene& scene, const Row& row, const Additions& additions);
// world_from_tool, without what the tracker makes of it.
Motion TrueTool(const Scene& scene, const Row& row, const Additions& additions);

// Without noise. slip: by how much the robot has missed its pose, right of base_from_platform.
Reading TrueReading(const Scene& scene,
                    const Row& row,
                    const Additions& additions,
                    const Six& slip = Six::Zero());

// Of the measured rows, in order.
std::vector<Reading> TrueReadings(const Scene& scene, const std::vector<HiddenEffect>& effects);

}  // namespace hexcal::hidden
