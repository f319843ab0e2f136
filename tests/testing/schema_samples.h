// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hexcal::testing {

// Files that hexcal takes, which use every key there is between them.
std::vector<std::string> DatasetSamples();
std::vector<std::string> ModelSamples();  // with every kind of effect
std::vector<std::string> RequirementSamples();
std::vector<std::string> ColumnSamples();
std::vector<std::string> PivotingSamples();
std::vector<std::string> StudySamples();

// The tables that the datasets name, (name, content).
std::vector<std::pair<std::string, std::string>> SampleTables();

// Parts of the readers' messages for what no schema can say.
extern const std::vector<const char*> kBeyondSchemas;

}  // namespace hexcal::testing
