// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hexcal {

// Reads a dataset's files, (name, content) each and dataset.yaml among them, as every other command
// will read them once they are in the folder out, and prints the warnings that come up. They lie in
// a private folder meanwhile, so that a dataset that is refused (InputError) leaves nothing in out.
void TryReading(const std::vector<std::pair<std::string, std::string>>& files,
                bool needs_measurement,
                const std::string& out);

}  // namespace hexcal
