// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "report/audit.h"
#include "report/digest.h"
#include "report/history/change_log.h"

namespace hexcal {

// Which inputs an audit is of, and what it is known by.
struct AuditIdentity {
  std::vector<HashedFile> inputs;
  // SHA-256 of the inputs' hashes, the settings that matter and result.json.
  std::string id;
  std::optional<ChangeLog> log = {};  // with --history; its head differs from run to run
};

// audit.json (docs/audit.md), format hexcal/audit/1. SI units, no times; what is not known is null.
// history only where there is a log.
std::string AuditJson(const AuditIdentity& identity, const Audit& audit);
std::string AuditJsonLine(const AuditIdentity& identity, const Audit& audit);

}  // namespace hexcal
