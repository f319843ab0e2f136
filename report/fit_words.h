// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/result_json.h"

namespace hexcal {

// "nonlinear, by poses", "linearized with the paper's error (equal weights), by poses".
std::string SolverWords(const ResultHeader& header);

// "Huber's, from 1.869 standard deviations of ..."; without one "none: ...".
std::string LossWords(const ResultHeader& header);

// What the stated covariance of the 12 is by.
std::string CovarianceWords(const ResultHeader& header);

}  // namespace hexcal
