// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>

#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/usage_error.h"
#include "config/nearest_word.h"

namespace hexcal {
namespace {

constexpr std::string_view kNoPrefix = "no";

[[noreturn]] void Refuse(const Command& command, std::string_view message) {
  throw UsageError(
      fmt::format("{}: {}\nTry 'hexcal help {}'.", command.name, message, command.name));
}

const Command& RequireCommand(const std::string& name) {
  if (const Command* command = FindCommand(name)) return *command;
  if (name.rfind('-', 0) == 0)
    throw UsageError(
        fmt::format("found '{}', expected a command first: hexcal COMMAND [FILES] [--flags]\n"
                    "Try 'hexcal help'.",
                    name));
  std::vector<std::string_view> known = {"help"};
  for (const Command& command : Commands()) known.push_back(command.name);
  throw UsageError(
      fmt::format("unknown command '{}'{}\nTry 'hexcal help'.", name, DidYouMean(name, known)));
}

[[noreturn]] void RefuseUnknown(const Command& command, std::string_view flag) {
  if (FindFlag(flag) != nullptr) {
    std::string owners;
    for (const Command& other : Commands()) {
      if (other.FindFlag(flag) != nullptr)
        owners += fmt::format("{}{}", owners.empty() ? "" : ", ", other.name);
    }
    Refuse(command, fmt::format("takes no --{} (that is for {})", flag, owners));
  }
  std::vector<std::string_view> known = {"help"};
  for (const CommandFlag& own : command.flags) known.push_back(own.name);
  const std::string nearest = NearestWord(flag, known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean '--{}'?)", nearest);
  Refuse(command, fmt::format("unknown flag --{}{}", flag, hint));
}

// Reads the arguments after the command, one after another.
class ArgumentReader {
 public:
  ArgumentReader(const std::vector<std::string>& arguments, CommandLine* line)
      : command_(*line->command), arguments_(arguments), line_(*line) {}

  void Read() {
    std::vector<std::string>& files = line_.files;
    while (next_ < arguments_.size()) {
      const std::string& argument = arguments_[next_++];
      if (argument == "--") {
        files.insert(files.end(), arguments_.begin() + next_, arguments_.end());
        break;
      }
      if (argument.rfind("--", 0) == 0) {
        ReadFlag(std::string_view(argument).substr(2));
      } else if (argument.size() > 1 && argument[0] == '-') {
        Refuse(command_,
               fmt::format("found '{}', expected a file or a flag with two dashes "
                           "(a file of that name goes after --)",
                           argument));
      } else {
        files.push_back(argument);
      }
    }
  }

 private:
  void ReadFlag(std::string_view argument) {
    const std::size_t equals = argument.find('=');
    const std::string_view name = argument.substr(0, equals);
    std::optional<std::string_view> value;
    if (equals != std::string_view::npos) value = argument.substr(equals + 1);
    if (!value && TakeNegatedSwitch(name)) return;
    if (command_.FindFlag(name) == nullptr) RefuseUnknown(command_, name);
    const FlagSpec& spec = *FindFlag(name);
    if (!value) value = IsSwitch(spec) ? "true" : NextValue(spec);
    Set(spec, *value);
  }

  // --noswitch
  bool TakeNegatedSwitch(std::string_view name) {
    if (name.substr(0, kNoPrefix.size()) != kNoPrefix) return false;
    const std::string_view positive = name.substr(kNoPrefix.size());
    const FlagSpec* spec = FindFlag(positive);
    if (spec == nullptr || !IsSwitch(*spec) || command_.FindFlag(positive) == nullptr) return false;
    Set(*spec, "false");
    return true;
  }

  std::string_view NextValue(const FlagSpec& spec) {
    const bool there = next_ < arguments_.size() && arguments_[next_].rfind("--", 0) != 0;
    if (!there)
      Refuse(command_,
             fmt::format("--{} has no value, expected {}", spec.name, ExpectedText(spec)));
    return arguments_[next_++];
  }

  void Set(const FlagSpec& spec, std::string_view value) {
    if (!line_.given.insert(spec.name).second)
      Refuse(command_, fmt::format("--{} is given twice", spec.name));
    if (const std::optional<std::string> expected = SetFlag(spec, value))
      Refuse(command_, fmt::format("--{}: found '{}', expected {}", spec.name, value, *expected));
  }

  const Command& command_;
  const std::vector<std::string>& arguments_;
  CommandLine& line_;
  std::size_t next_ = 0;
};

bool Takes(const Command& command, std::string_view flag) {
  return std::any_of(command.flags.begin(), command.flags.end(), [flag](const CommandFlag& use) {
    return use.name == flag;
  });
}

void CheckNumberOfFiles(const Command& command, const std::vector<std::string>& files) {
  if (files.size() >= command.min_files && files.size() <= command.max_files) return;
  if (files.empty()) Refuse(command, fmt::format("found no file, expected {}", command.arguments));
  if (command.max_files == 0)
    Refuse(command,
           fmt::format("found '{}', expected no file{}",
                       files[0],
                       Takes(command, "out") ? " (where the files go is --out=DIR)" : ""));
  Refuse(command, fmt::format("found {} files, expected {}", files.size(), command.arguments));
}

CommandLine HelpLine(const std::vector<std::string>& arguments) {
  CommandLine line;
  line.action = CommandLine::Action::kHelp;
  if (arguments.size() > 2)
    throw UsageError("help: found several commands, expected one\nTry 'hexcal help'.");
  if (arguments.size() == 2 && arguments[1] != "help") line.command = &RequireCommand(arguments[1]);
  return line;
}

bool AsksForHelp(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::any_of(arguments.begin(), end, [](const std::string& argument) {
    return argument == "--help" || argument == "-h";
  });
}

}  // namespace

CommandLine ParseCommandLine(const std::vector<std::string>& arguments) {
  if (arguments.empty())
    throw UsageError("expected a command: hexcal COMMAND [FILES] [--flags]\nTry 'hexcal help'.");
  const std::string& first = arguments[0];
  CommandLine line;
  if (first == "--version") {
    line.action = CommandLine::Action::kVersion;
    return line;
  }
  if (first == "--help" || first == "-h") {
    line.action = CommandLine::Action::kHelp;
    return line;
  }
  if (first == "help") return HelpLine(arguments);
  line.command = &RequireCommand(first);
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (AsksForHelp(rest)) {
    line.action = CommandLine::Action::kHelp;
    return line;
  }
  ArgumentReader(rest, &line).Read();
  CheckNumberOfFiles(*line.command, line.files);
  return line;
}

void CheckComplete(const CommandLine& line) {
  const Command& command = *line.command;
  for (const CommandFlag& own : command.flags) {
    const FlagSpec& spec = *FindFlag(own.name);
    if (own.required && !WasGiven(spec))
      Refuse(
          command,
          fmt::format("--{}={} is missing", own.name, own.value.empty() ? spec.value : own.value));
    if (!spec.together_with.empty() && WasGiven(spec) && !WasGiven(*FindFlag(spec.together_with)))
      Refuse(command, fmt::format("--{} needs --{} beside it", own.name, spec.together_with));
    if (spec.only_with_flag.empty() || line.given.count(own.name) == 0) continue;
    if (command.FindFlag(spec.only_with_flag) == nullptr) continue;  // it always has that effect
    if (CurrentText(*FindFlag(spec.only_with_flag)) == spec.only_with_value) continue;
    Refuse(command,
           fmt::format("--{} has an effect only with --{}={}",
                       own.name,
                       spec.only_with_flag,
                       spec.only_with_value));
  }
}

}  // namespace hexcal
