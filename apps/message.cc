// SPDX-License-Identifier: BSD-3-Clause
#include "apps/message.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "apps/progress.h"

namespace hexcal {
namespace {

constexpr std::string_view kRed = "\x1b[1;31m", kYellow = "\x1b[1;33m", kEnd = "\x1b[m";

// Where stderr itself is full nobody can be told: no reason to end otherwise than one would.
void Print(std::string_view start, std::string_view colour, std::string_view text) {
  Progress::ClearVisible();
  std::fflush(stdout);
  static const bool is_coloured =
      IsColoured(isatty(STDERR_FILENO) == 1, std::getenv("NO_COLOR"), std::getenv("TERM"));
  std::string line(start);
  if (is_coloured) line.insert(0, colour).append(kEnd);
  std::fputs(line.append(" ").append(text).append("\n").c_str(), stderr);
}

}  // namespace

bool IsColoured(bool is_terminal, const char* no_color, const char* term) {
  const bool is_forbidden = no_color != nullptr && *no_color != '\0';
  const bool is_dumb = term == nullptr || *term == '\0' || std::string_view(term) == "dumb";
  return is_terminal && !is_forbidden && !is_dumb;
}

void PrintError(std::string_view text) { Print("hexcal:", kRed, text); }

void PrintWarning(std::string_view text) { Print("hexcal: warning:", kYellow, text); }

}  // namespace hexcal
