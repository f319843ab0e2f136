// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "apps/stage_bars.h"
#include "report/audit.h"

namespace hexcal {

// Looks for effects that the data ask for beyond base, tool and the model's, or says why that was
// not done. Nothing where the calibration cannot be trusted anyway.
void ScreenFor(const std::optional<Machine>& model, StageBars* bars, AuditInput* input);

}  // namespace hexcal
