// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/output_folder.h"

namespace hexcal {

// Datasets that import and init write are made to be worked on by hand, so that a second run must
// not take them for its own: their second line is the SHA-256 of dataset.yaml (without that line)
// and of the tables that it names.

// Puts that line into the dataset, one of the files (name, content), whose first line is a comment;
// the others are its tables.
void SignFiles(std::vector<std::pair<std::string, std::string>>& files, const std::string& dataset);

// OutputError where the folder's dataset of this name is not, with its tables, as SignFiles left
// it. One that is not there is not changed.
void RequireUnchanged(const OutputFolder& folder, const std::string& dataset);

}  // namespace hexcal
