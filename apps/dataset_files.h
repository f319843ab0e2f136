// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// ReadDataset, its warnings printed on stderr.
Dataset OpenDataset(const std::string& path, bool needs_measurement);

// Prints the first ten of the warnings that OpenDataset has not printed; file holds all.
void PrintNewWarnings(const Dataset& dataset,
                      const std::vector<std::string>& warnings,
                      const std::string& file);

// The dataset's file and tables, and the model's file unless that is empty: what a run must not
// overwrite.
std::vector<std::string> InputFiles(const Dataset& dataset, const std::string& model);

}  // namespace hexcal
