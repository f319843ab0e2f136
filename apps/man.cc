// SPDX-License-Identifier: BSD-3-Clause
#include "apps/man.h"

#include <fmt/format.h>

#include "apps/exit_status.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/help.h"
#include "apps/version.h"

namespace hexcal {
namespace {

constexpr std::string_view kDate = "2026-11-23";  // of the page's words, not of a build

// Text in which nothing is a request or an escape. A hyphen that is to be copied is \-.
std::string Plain(std::string_view text) {
  std::string plain;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) plain += "\\&";
    begins = c == '\n';
    if (c == '\\')
      plain += "\\e";
    else if (c == '-')
      plain += "\\-";
    else
      plain += c;
  }
  return plain;
}

// Paragraphs; lines that begin with two blanks are a list.
std::string Paragraphs(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const bool is_item = line.substr(0, 2) == "  ";
    out += is_item ? fmt::format(".IP \\(bu 2\n{}\n", Plain(line.substr(2)))
                   : fmt::format(".PP\n{}\n", Plain(line));
  }
  return out;
}

std::string Unfilled(std::string_view text) { return fmt::format(".nf\n{}\n.fi\n", Plain(text)); }

std::string Section(const Command& command) {
  std::string text = fmt::format(".SS {}\n.B {}\n", command.name, Plain(UsageLine(command)));
  text += Paragraphs(command.description);
  for (const CommandFlag& flag : command.flags)
    text += fmt::format(".TP\n.B {}\n{}\n", Plain(FlagForm(flag)), Plain(FlagText(flag)));
  for (const CommandExample& example : command.examples)
    text += fmt::format(
        ".PP\n{}\n.RS 4\n{}.RE\n", Plain(example.what), Unfilled(WrapExample(example.line, 0)));
  return text;
}

int RunMan(const std::vector<std::string>& /*files*/) {
  fmt::print("{}", ManPage());
  return kDone;
}

}  // namespace

std::string ManPage() {
  const std::string version = VersionText();
  std::string text = fmt::format(".TH HEXCAL 1 {} \"{}\" \"User Commands\"\n.ad l\n",
                                 kDate,
                                 Plain(version.substr(0, version.find('\n'))));
  text += ".SH NAME\nhexcal \\- base and tool calibration of hexapods from optical tracker data\n";
  text +=
      ".SH SYNOPSIS\n.B hexcal\n.I COMMAND\n[FILES] [\\-\\-flags]\n.br\n.B hexcal help\n.RI [ "
      "COMMAND ]\n"
      ".br\n.B hexcal \\-\\-version\n";
  text += ".SH DESCRIPTION\n";
  text += Plain(
              "Finds where a hexapod's base and tool really are, with their covariance, from what "
              "an optical tracker saw, and what the model of the machine still misses.") +
          "\n";
  text += Paragraphs(
      "Results go to stdout and into files, everything else to stderr. A flag is "
      "--name=value or --name value; a switch is --name or --noname; what follows -- "
      "is a file.");
  text += ".SH COMMANDS\n";
  for (const Command& command : Commands()) text += Section(command);
  text += ".SH EXIT STATUS\n" + Unfilled(ExitStatusText());
  text += ".SH ENVIRONMENT\n.TP\n.B NO_COLOR\n" +
          Plain("If it is set and not empty, messages on a terminal have no colour.") + "\n";
  return text;
}

Command ManCommand() {
  return {
      "man",
      "the manual page, hexcal(1)",
      "",
      0,
      0,
      "Prints the manual page of all commands and flags as man reads it. Installed with hexcal; "
      "where it is not, 'hexcal man | man -l -' shows it.",
      {},
      &RunMan,
      {{"hexcal man > hexcal.1", "For a folder of man pages."}}};
}

}  // namespace hexcal
