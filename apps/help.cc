// SPDX-License-Identifier: BSD-3-Clause
#include "apps/help.h"

#include <fmt/format.h>
#include <gflags/gflags.h>

#include <string_view>
#include <vector>

#include "apps/flag_value.h"
#include "apps/flags.h"

namespace hexcal {
namespace {

constexpr std::size_t kWidth = 79;

// Text in lines of at most kWidth, each after indent spaces; a line of its own that begins with two
// blanks (an entry of a list) is indented by them.
std::string Wrap(std::string_view text, std::size_t indent) {
  std::string lines, line;
  const std::size_t line_end = text.find('\n');
  if (line_end != std::string_view::npos)
    return Wrap(text.substr(0, line_end), indent) + Wrap(text.substr(line_end + 1), indent);
  if (text.substr(0, 2) == "  ") return Wrap(text.substr(2), indent + 2);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && indent + line.size() + 1 + word.size() > kWidth) {
      lines += fmt::format("{:{}}{}\n", "", indent, line);
      line.clear();
    }
    line += (line.empty() ? "" : " ");
    line += word;
  }
  return lines + fmt::format("{:{}}{}\n", "", indent, line);
}

std::string JoinBars(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : "|") + std::string(word);
  return text;
}

std::string FlagHelp(const CommandFlag& own) {
  return fmt::format("  {}\n{}", FlagForm(own), Wrap(FlagText(own), 6));
}

std::string ExamplesHelp(const Command& command) {
  if (command.examples.empty()) return "";
  std::string text = "\nExamples\n";
  for (const CommandExample& example : command.examples)
    text += Wrap(example.what, 2) + WrapExample(example.line, 6);
  return text;
}

// The groups in the order of the table of flags.
std::vector<std::string_view> Groups() {
  std::vector<std::string_view> groups;
  for (const FlagSpec& spec : FlagSpecs()) {
    if (groups.empty() || groups.back() != spec.group) groups.push_back(spec.group);
  }
  return groups;
}

constexpr std::string_view kExitStatus = R"(  0    done
  1    internal error
  2    wrong usage
  3    an input was refused
  4    base and tool cannot be trusted: no convergence, or a direction that the
       data cannot determine (the result is written, and says so)
  5    a file could not be written
  6    some of several datasets failed (the rest are done)
  7    a requirement failed, under audit --gate
  130  interrupted
)";

}  // namespace

std::string_view ExitStatusText() { return kExitStatus; }

std::string FlagForm(const CommandFlag& own) {
  const FlagSpec& spec = *FindFlag(own.name);
  if (IsSwitch(spec)) return fmt::format("--{}", own.name);
  if (!spec.choices.empty()) return fmt::format("--{}={}", own.name, JoinBars(spec.choices));
  return fmt::format("--{}={}", own.name, own.value.empty() ? spec.value : own.value);
}

std::string WrapExample(std::string_view line, std::size_t indent) {
  std::string text, part;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(std::min(end + 1, line.size()));
    if (!part.empty() && part.size() + word.size() + 5 > kWidth) {
      text += part + " \\\n";
      part = std::string(indent + 3, ' ');
    }
    part += (part.empty() ? std::string(indent, ' ') : " ") + std::string(word);
  }
  return text + part + "\n";
}

std::string FlagText(const CommandFlag& own) {
  const FlagSpec& spec = *FindFlag(own.name);
  gflags::CommandLineFlagInfo info;
  gflags::GetCommandLineFlagInfo(std::string(own.name).c_str(), &info);
  std::string text(own.help.empty() ? info.description : own.help);
  if (IsNumber(spec)) text += fmt::format(" {}{}.", "Takes ", ExpectedText(spec));
  if (own.required) return text + " Required.";
  const std::string default_text = DefaultText(spec);
  if (!default_text.empty()) text += fmt::format(" Default: {}.", default_text);
  return text;
}

std::string UsageLine(const Command& command) {
  std::string text = fmt::format("hexcal {}", command.name);
  if (!command.arguments.empty()) text += fmt::format(" {}", command.arguments);
  for (const CommandFlag& own : command.flags) {
    if (own.required) text += " " + FlagForm(own);
  }
  return command.flags.empty() ? text : text + " [flags]";
}

std::string CommandHelp(const Command& command) {
  std::string text = fmt::format("{}\n\n", UsageLine(command));
  text += Wrap(command.description, 0);
  text += ExamplesHelp(command);
  for (const std::string_view group : Groups()) {
    std::string flags;
    for (const CommandFlag& own : command.flags) {
      if (FindFlag(own.name)->group == group) flags += FlagHelp(own);
    }
    if (!flags.empty()) text += fmt::format("\n{}\n{}", group, flags);
  }
  if (command.flags.empty()) return text;
  text += "\nA switch such as --quiet is turned off by --noquiet. What follows -- is a file.\n";
  return text;
}

std::string ProgramHelp() {
  std::string text =
      "hexcal: base and tool calibration of hexapods from optical tracker data\n\n"
      "hexcal COMMAND [FILES] [--flags]\n\nCommands\n";
  for (const Command& command : Commands())
    text += fmt::format("  {:<10} {}\n", command.name, command.summary);
  text += fmt::format("  {:<10} {}\n", "help", "this text; 'hexcal help COMMAND' for one command");
  text += "\n'hexcal --version' prints the version and those of the libraries.\n";
  return text + "\nExit status\n" + std::string(kExitStatus);
}

}  // namespace hexcal
