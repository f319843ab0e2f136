// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/effect.h"
#include "model/visit.h"

namespace hexcal {

// The values of a searched parameter worth trying, so dense that the best one loses a few per cent
// at most: periods evenly in frequency from three a travel to the shortest that the poses can
// hold apart; times of steps between measured poses; time constants as parts of the whole time.
// rows: of the measured poses.
std::vector<double> GridFor(const EffectKind& kind,
                            const ParameterKind& parameter,
                            const std::vector<Visit>& visits,
                            const std::vector<int>& rows,
                            const EffectReference& reference);

}  // namespace hexcal
