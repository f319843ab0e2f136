// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// How many insertions, deletions, substitutions and exchanges of neighbours make b of a, no letter
// being changed twice; case does not count (Damerau 1964; optimal string alignment).
std::size_t EditDistance(std::string_view a, std::string_view b);

// The known word nearest to word, else the only one that begins with it (three letters or more),
// else "". Near is an edit distance of at most a third of its length: 0 up to two letters (that is,
// but for case), 1 up to five, 2 up to eight. Of several as near, the first.
std::string NearestWord(std::string_view word, const std::vector<std::string_view>& known);

// " (did you mean 'solver'?)" for the end of a message; "" when none is near.
std::string DidYouMean(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace hexcal
