// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "testing/temporary_folder.h"

namespace hexcal::testing {

struct ProgramResult {
  int status = -1;  // 128 + the signal's number if a signal ended it
  std::string out;
  std::string err;
};

struct ProgramRun {
  std::vector<std::string> arguments;
  std::string folder = ".";  // where it runs
  std::vector<std::pair<std::string, std::string>> environment = {};
  std::string out = {};  // a file for stdout, in place of ProgramResult::out
};

// Runs a program without standard input and waits for its end.
inline ProgramResult RunProgram(const std::string& program, const ProgramRun& run) {
  const TemporaryFolder logs;
  const std::string out = run.out.empty() ? logs.Write("out", "") : run.out;
  const std::string err = logs.Write("err", "");
  std::vector<char*> argv = {const_cast<char*>(program.c_str())};
  for (const std::string& argument : run.arguments)
    argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    for (const auto& [name, value] : run.environment) setenv(name.c_str(), value.c_str(), 1);
    const bool ready = chdir(run.folder.c_str()) == 0 &&
                       dup2(open("/dev/null", O_RDONLY), STDIN_FILENO) >= 0 &&
                       dup2(open(out.c_str(), O_WRONLY), STDOUT_FILENO) >= 0 &&
                       dup2(open(err.c_str(), O_WRONLY), STDERR_FILENO) >= 0;
    if (ready) execv(program.c_str(), argv.data());
    _exit(127);
  }
  int status = 0;
  ProgramResult result;
  if (child < 0 || waitpid(child, &status, 0) != child) return result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = run.out.empty() ? logs.Read("out") : "";
  result.err = logs.Read("err");
  return result;
}

#ifdef HEXCAL_PROGRAM
// The built hexcal.
inline ProgramResult RunHexcal(const ProgramRun& run) { return RunProgram(HEXCAL_PROGRAM, run); }
#endif

}  // namespace hexcal::testing
