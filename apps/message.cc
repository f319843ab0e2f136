// SPDX-License-Identifier: BSD-3-Clause
#include "apps/message.h"

#include <cstdio>
#include <string>

#include "apps/progress.h"

namespace hexcal {
namespace {

// Where stderr itself is full nobody can be told: no reason to end otherwise than one would.
void Print(std::string_view kind, std::string_view text) {
  Progress::ClearVisible();
  std::fflush(stdout);
  std::fputs(std::string("hexcal: ").append(kind).append(text).append("\n").c_str(), stderr);
}

}  // namespace

void PrintError(std::string_view text) { Print("", text); }

void PrintWarning(std::string_view text) { Print("warning: ", text); }

}  // namespace hexcal
