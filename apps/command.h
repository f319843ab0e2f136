// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hexcal {

// A flag as one command takes it.
struct CommandFlag {
  std::string_view name;
  bool required = false;
  std::string_view value =
      {};                      // stands for the value in help, where it is not the flag's usual one
  std::string_view help = {};  // in place of the flag's own description
};

// A call that works as it stands in the folder of the sources, where examples/ is.
struct CommandExample {
  std::string_view line;
  std::string_view what;  // it does
};

struct Command {
  std::string_view name;
  std::string_view summary;    // one line, for the list of commands
  std::string_view arguments;  // "DATASET...", for usage
  std::size_t min_files;
  std::size_t max_files;
  std::string_view description;  // paragraphs, for help
  std::vector<CommandFlag> flags;
  int (*run)(const std::vector<std::string>& files);  // gives the exit status
  std::vector<CommandExample> examples = {};
  std::vector<std::string_view> first_words =
      {};  // that the first argument may be, if it is no file

  const CommandFlag* FindFlag(std::string_view flag) const;  // nullptr if it takes none such
};

// The table of commands: parsing, help and error messages all read it.
const std::vector<Command>& Commands();
const Command* FindCommand(std::string_view name);  // nullptr if there is none

}  // namespace hexcal
