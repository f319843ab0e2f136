// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/compare.h"
#include "report/html/page.h"

namespace hexcal {

// Parts of a page on how methods compare.

// Each method's distance from the nonlinear solution and its held-out error, and how the paper's
// iteration and the nonlinear solver arrived.
void AddMethods(const Comparison& comparison, HtmlPage* page);

// Whether the covariance of first order may be used (JCGM 101:2008, clause 8).
void AddPropagation(const PropagationCheck& propagation, HtmlPage* page);

}  // namespace hexcal
