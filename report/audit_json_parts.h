// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "report/audit.h"

namespace hexcal {

// Parts of audit.json (docs/audit.md). SI units.

nlohmann::ordered_json JsonNumber(double value);  // null for NaN and infinities
nlohmann::ordered_json JsonFit(const ResultHeader& header);
nlohmann::ordered_json JsonCoverage(const Coverage& coverage);
nlohmann::ordered_json JsonRows(const Audit& audit);
nlohmann::ordered_json JsonPoseDesign(const PoseDesign& design);
nlohmann::ordered_json JsonBudget(const Budget& budget);
nlohmann::ordered_json JsonParameters(const Budget& budget);
nlohmann::ordered_json JsonValidation(const PointValidation& validation);
nlohmann::ordered_json JsonLinearity(const Audit& audit);
nlohmann::ordered_json JsonChange(const Audit& audit);  // which must have one

}  // namespace hexcal
