// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "config/strict_yaml.h"
#include "estimator/calibrate.h"

namespace hexcal {

// The flags of a command that the settings of a manifest may hold.
std::vector<std::string_view> BatchSettings(std::string_view command);

// Sets the flags of a command that a manifest's mapping names, those of results and of running
// excepted. Null: nothing to set. InputError with file and line.
void ApplyBatchSettings(std::string_view command, const YamlNode* settings);

// calibrate's options as the flags are now; what does not go together is the fault of settings.
CalibrateOptions OptionsAt(const YamlNode* settings);

}  // namespace hexcal
