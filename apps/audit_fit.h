// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "report/audit.h"

namespace hexcal {

// What an audit is asked for.
struct AuditTask {
  const Dataset& dataset;
  const std::optional<Machine>& model;  // with effects, which are fitted along
  const std::optional<Requirements>& requirements;
  const std::optional<EarlierResult>& earlier;
};

struct AuditedMachine {
  Audit audit;
  Machine machine;  // as it was calibrated
};

// Fits as the flags say, compares the methods, repeats the fit, looks for missing effects, judges.
AuditedMachine FitAndAudit(const AuditTask& task);

}  // namespace hexcal
