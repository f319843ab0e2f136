// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/flags.h"

namespace hexcal {

bool IsSwitch(const FlagSpec& spec);  // true or false, --name and --noname
bool IsWholeNumber(const FlagSpec& spec);
bool IsNumber(const FlagSpec& spec);  // a whole number or a real one
bool WasGiven(const FlagSpec& spec);  // on the command line or in the config file
std::string CurrentText(const FlagSpec& spec);
std::string DefaultText(const FlagSpec& spec);  // for help; empty where there is none

// What the flag takes, in words: "nonlinear or linearized", "a number above 0, at most 1".
std::string ExpectedText(const FlagSpec& spec);

// Sets the flag. nullopt if text is a value that it takes, else what was expected instead; the flag
// is then left as it was.
std::optional<std::string> SetFlag(const FlagSpec& spec, std::string_view text);

}  // namespace hexcal
