// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/discovery.h"

namespace hexcal {

// Sentences that the table on the screen and the report share. UTF-8, not escaped.

// "The gap between prediction and measurement is explained by leg_gain (leg 3)."
std::string VerdictSentence(const Discovery& discovery);

// What the verdict means for who reads it, one sentence.
std::string VerdictMeaning(Verdict verdict);

// "leg 1, leg 2 and leg 5", "all legs" (or base or platform joints) where it is all six,
// else the site.
std::string CarriersOf(const DiscoveredEffect& found);

// "gain: leg 3 123 ± 4 ppm", a line a parameter that is not zero by construction; what was found
// for a fault of the data.
std::vector<std::string> SizesOf(const DiscoveredEffect& found);

// What noise was found, a sentence each; nothing where it is as stated.
std::vector<std::string> NoiseSentences(const NoiseFound& noise);

// "leg_gain (3)", "leg_gain (all six)".
std::string NameWithIndex(const std::string& name, const std::vector<int>& index);

// Whether the held-out test was done.
bool IsKnown(const GapSize& size);

// "a, b and c".
std::string JoinWords(const std::vector<std::string>& words);

}  // namespace hexcal
