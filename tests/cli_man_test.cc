// SPDX-License-Identifier: BSD-3-Clause
// hexcal man: every command and flag, in a form that man and mandoc read without a complaint.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "apps/command.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::RunProgram;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string Page() {
  const ProgramResult result = RunHexcal({{"man"}});
  EXPECT_EQ(result.status, 0) << result.err;
  return result.out;
}

TEST(CliMan, HasEveryCommandAndFlag) {
  const std::string page = Page();
  for (const Command& command : Commands()) {
    const std::size_t at = page.find("\n.SS " + std::string(command.name) + "\n");
    ASSERT_NE(at, std::string::npos) << command.name;
    const std::string own = page.substr(at + 1, page.find("\n.S", at + 1) - at);
    for (const CommandFlag& flag : command.flags)
      EXPECT_THAT(own, HasSubstr("\n.B \\-\\-" + std::string(flag.name)));
  }
  for (const char* section : {"NAME", "SYNOPSIS", "DESCRIPTION", "EXIT STATUS", "ENVIRONMENT"})
    EXPECT_THAT(page, HasSubstr("\n.SH " + std::string(section) + "\n"));
}

// Lines that begin with a dot are requests that man has; backslashes are escapes that roff has.
TEST(CliMan, IsRoff) {
  const std::string page = Page();
  EXPECT_EQ(page.rfind(".TH HEXCAL 1 ", 0), 0u);
  const std::set<std::string> requests = {".TH",
                                          ".SH",
                                          ".SS",
                                          ".B",
                                          ".I",
                                          ".RI",
                                          ".br",
                                          ".PP",
                                          ".IP",
                                          ".TP",
                                          ".nf",
                                          ".fi",
                                          ".RS",
                                          ".RE",
                                          ".ad"};
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '.') {
      EXPECT_EQ(requests.count(line.substr(0, line.find(' '))), 1u) << line;
    }
    EXPECT_NE(line[0], '\'') << line;
  }
  for (std::size_t at = page.find('\\'); at != std::string::npos; at = page.find('\\', at + 2))
    EXPECT_NE(std::string("-e&(").find(page[at + 1]), std::string::npos) << page.substr(at, 20);
}

// Where they are installed.
TEST(CliMan, PleasesManAndMandoc) {
  const TemporaryFolder folder;
  const std::string file = folder.Write("hexcal.1", Page());
  for (const std::string& line :
       {"if command -v mandoc >/dev/null; then mandoc -T lint -W warning " + file + "; fi",
        "if command -v man >/dev/null && command -v groff >/dev/null; then "
        "LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l " +
            file + " >/dev/null; fi"}) {
    const ProgramResult result = RunProgram("/bin/bash", {{"-c", line}});
    EXPECT_EQ(result.status, 0) << result.out << result.err;
    EXPECT_THAT(result.out + result.err, IsEmpty());
  }
}

}  // namespace
}  // namespace hexcal
