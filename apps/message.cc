// SPDX-License-Identifier: BSD-3-Clause
#include "apps/message.h"

#include <fmt/format.h>

#include <cstdio>

#include "apps/progress.h"

namespace hexcal {

void PrintError(std::string_view text) {
  Progress::ClearVisible();
  std::fflush(stdout);
  fmt::print(stderr, "hexcal: {}\n", text);
}

void PrintWarning(std::string_view text) {
  Progress::ClearVisible();
  std::fflush(stdout);
  fmt::print(stderr, "hexcal: warning: {}\n", text);
}

}  // namespace hexcal
