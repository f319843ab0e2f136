// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/plan.h"

namespace hexcal {

// Sentences that the table on the screen, the CSV and the JSON of a plan share. UTF-8.

// What a planned pose is for: "tells leg_gain from leg_thermal", "determines tool.rx".
std::string ReasonText(const Plan& plan, const PoseReason& reason);

// Whether and how a pair can be told apart, one sentence.
std::string SeparationSentence(const Plan& plan, const RivalPair& pair);

// The chance that the wrong one of two effects fits better: Phi(-distance / 2).
double ChanceOfMistake(double distance);

}  // namespace hexcal
