// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "apps/calibrate_options.h"
#include "apps/command.h"
#include "apps/config_file.h"
#include "apps/flag_value.h"
#include "apps/usage_error.h"

namespace hexcal {
namespace {

// Where results go and how a run goes on is the batch's own business.
constexpr std::array<std::string_view, 8> kNotSettings = {
    "out", "report", "model", "config", "threads", "json", "quiet", "force"};

}  // namespace

std::vector<std::string_view> BatchSettings(std::string_view command) {
  std::vector<std::string_view> keys;
  for (const CommandFlag& flag : FindCommand(command)->flags)
    if (std::find(kNotSettings.begin(), kNotSettings.end(), flag.name) == kNotSettings.end())
      keys.push_back(flag.name);
  return keys;
}

void ApplyBatchSettings(std::string_view command, const YamlNode* settings) {
  if (settings == nullptr) return;
  ApplySettings(*settings, fmt::format("the settings of {}", command), BatchSettings(command));
  for (const auto& [key, value] : settings->entries) {
    const std::string_view other = FindFlag(key.scalar)->together_with;
    if (!other.empty() && !WasGiven(*FindFlag(other)))
      throw InputError(key.where, key.scalar, fmt::format("{} beside it", other));
  }
}

CalibrateOptions OptionsAt(const YamlNode* settings) {
  try {
    return CalibrateOptionsFromFlags();
  } catch (const UsageError& error) {
    if (settings == nullptr) throw;
    throw InputError(settings->where, error.what());
  }
}

}  // namespace hexcal
