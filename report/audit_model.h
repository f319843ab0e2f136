// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/audit.h"
#include "report/html/page.h"

namespace hexcal {

// What an audit says of a model with effects.

// The places that the legs reach with the effects.
void KeepReached(const GrownTarget& grown, std::vector<Place>* places);

// The poses of the calibration, each with its own time, load, way there.
std::vector<Place> PosesOf(const GrownSolution& solution);

// Why nothing may pass: what of the model is taken as exact, what the data do not determine, and
// where the uncertainty rests on plausible sizes. Nothing without a model.
void AddDoubtsOfModel(const Audit& audit, std::vector<std::string>* doubts);

// The effects with what they are and how sure that is. Only of an audit with a model.
void AddModelEffects(const Audit& audit, HtmlPage* page);
nlohmann::ordered_json JsonModel(const Audit& audit);

}  // namespace hexcal
