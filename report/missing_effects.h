// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/audit.h"
#include "report/html/page.h"

namespace hexcal {

// What an audit says of effects that its model lacks.

// Nothing passes while the data ask for an effect that is not in the model.
void AddDoubtsOfMissing(const Audit& audit, std::vector<std::string>* doubts);

void AddMissingEffects(const Audit& audit, HtmlPage* page);
nlohmann::ordered_json JsonMissingEffects(const Audit& audit);

}  // namespace hexcal
