// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hexcal {

// What a command that only makes files says of them: the files in the order in which they were
// asked for, and numbers of what is in them ("poses"). One line.
std::string WrittenJsonLine(std::string_view command,
                            const std::vector<std::string>& files,
                            const std::vector<std::pair<std::string, std::size_t>>& counts);

}  // namespace hexcal
