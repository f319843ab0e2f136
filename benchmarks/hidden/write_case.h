// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "hidden/hidden_case.h"

namespace hexcal::hidden {

// The files of a case as (name, content), docs/dataset.md: dataset.yaml, poses.csv and markers.csv;
// heldout/ with the other rows' true tool poses; truth.json, which says what is hidden.
std::vector<std::pair<std::string, std::string>> CaseFiles(const Case& made,
                                                           const CaseOptions& options);

}  // namespace hexcal::hidden
