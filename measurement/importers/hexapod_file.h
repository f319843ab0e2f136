// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/hexapod_geometry.h"

namespace hexcal {

// The hexapod of a YAML file that has `units:` and `hexapod:` as a dataset has; its other keys are
// not looked at, so that it may be a dataset.
HexapodGeometry ReadHexapodFile(const std::string& path);

}  // namespace hexcal
