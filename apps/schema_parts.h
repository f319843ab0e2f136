// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/command.h"

namespace hexcal {

// Parts of JSON Schemas that follow from hexcal's own tables.

// An effect in model.yaml, by the table of effects: its parameters, index, reference and words.
nlohmann::ordered_json EffectSchema();

// The names that an effect, a method of compare and an order of rotations may have: an enum each,
// by the name of the definition.
nlohmann::ordered_json NameSchemas();

// A --config file, by the table of flags; of one command, or (nullptr) with the flags of all.
nlohmann::ordered_json SettingsSchema(const Command* command);

// The settings in a manifest of batch.
nlohmann::ordered_json BatchSettingsSchema(const Command& command);

}  // namespace hexcal
