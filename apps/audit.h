// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hexcal {

int RunAudit(const std::vector<std::string>& files);

}  // namespace hexcal
