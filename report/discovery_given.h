// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "discovery/discovery.h"
#include "report/html/page.h"

namespace hexcal {

// What discovery says of the effects of the model that it was started from.

// "base and tool alone", or with a model "base, tool and what was given".
std::string StartOf(const Discovery& discovery);

// "confirmed", "changed: ...", in one sentence.
std::string SentenceOf(const GivenEffect& given);

void AddGiven(const Discovery& discovery, HtmlPage* page);
nlohmann::ordered_json JsonGiven(const Discovery& discovery);

}  // namespace hexcal
