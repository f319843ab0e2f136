// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "config/strict_yaml.h"
#include "config/units.h"

namespace hexcal {

// {length: m | mm, angle: rad | deg}. InputError for anything else.
Units ReadUnits(const YamlNode& node);

}  // namespace hexcal
