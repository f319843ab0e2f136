// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "report/audit.h"
#include "report/audit_json.h"
#include "report/run_record.h"

namespace hexcal {

// report.html of an audit: one file that opens offline (report/html/page.h). It has the time of the
// run. result: the text of result.json, which stands in it as audit.json's does, for programs.
std::string AuditHtml(const AuditIdentity& identity,
                      const RunRecord& record,
                      const Audit& audit,
                      std::string_view result);

}  // namespace hexcal
