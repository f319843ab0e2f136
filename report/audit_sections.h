// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/audit.h"
#include "report/html/page.h"
#include "report/run_record.h"

namespace hexcal {

// The sections of an audit's report that are about numbers, and what goes into some.
void AddRowCounts(const Audit& audit, HtmlPage* page);
void AddPoseDesign(const Audit& audit, HtmlPage* page);
void AddLinearizedAgainstNonlinear(const Audit& audit,
                                   const std::vector<MethodTime>& times,
                                   HtmlPage* page);
void AddGoodnessOfFit(const Audit& audit, HtmlPage* page);
void AddBudget(const Audit& audit, HtmlPage* page);
void AddValidation(const Audit& audit, HtmlPage* page);
void AddBias(const Audit& audit, HtmlPage* page);  // what goes below that
void AddAccuracy(const Audit& audit, HtmlPage* page);
void AddChange(const Audit& audit, HtmlPage* page);

}  // namespace hexcal
