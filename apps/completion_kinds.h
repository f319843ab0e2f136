// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/command.h"

namespace hexcal {

// What may stand in a place of the command line.
struct CompletionKind {
  enum class Sort { kNothing, kWords, kFolder, kFile };
  Sort sort = Sort::kNothing;
  std::vector<std::string_view> words = {};  // kWords
  std::string extension = {};                // kFile: "yaml"; empty: any
};

CompletionKind KindOfFlag(const CommandFlag& flag);
CompletionKind KindOfFiles(const Command& command);  // its arguments but for first_words

std::string JoinWords(const std::vector<std::string_view>& words);  // with blanks between

}  // namespace hexcal
