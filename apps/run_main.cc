// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run_main.h"

#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <locale>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "apps/command.h"
#include "apps/command_line.h"
#include "apps/config_file.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/help.h"
#include "apps/interrupt.h"
#include "apps/message.h"
#include "apps/usage_error.h"
#include "apps/version.h"
#include "config/input_error.h"

namespace hexcal {
namespace {

// Not [[noreturn]]: glog's type has the older attribute, and clang tells them apart.
__attribute__((noreturn)) void ExitOnFailedCheck() { _exit(kInternalError); }

// Messages of the libraries go to stderr, and nothing else is left behind, whatever GLOG_* says.
void StartLogging(const char* program) {
  FLAGS_logtostderr = true;
  FLAGS_logtostdout = false;
  FLAGS_minloglevel = google::GLOG_WARNING;
  google::InitGoogleLogging(program);
  google::InstallFailureFunction(&ExitOnFailedCheck);
}

int RunCommand(const CommandLine& line) {
  if (!FLAGS_config.empty()) ApplyConfigFile(FLAGS_config, line);
  CheckComplete(line);
  return line.command->run(line.files);
}

int Dispatch(const std::vector<std::string>& arguments) {
  const CommandLine line = ParseCommandLine(arguments);
  switch (line.action) {
    case CommandLine::Action::kHelp:
      fmt::print("{}", line.command ? CommandHelp(*line.command) : ProgramHelp());
      return kDone;
    case CommandLine::Action::kVersion:
      fmt::print("{}", VersionText());
      return kDone;
    case CommandLine::Action::kRun:
      break;
  }
  return RunCommand(line);
}

int Guarded(const std::vector<std::string>& arguments) {
  try {
    return Dispatch(arguments);
  } catch (const UsageError& error) {
    PrintError(error.what());
    return kWrongUsage;
  } catch (const InputError& error) {
    PrintError(error.what());
    return kInputRefused;
  } catch (const OutputError& error) {
    PrintError(error.what());
    return kCannotWrite;
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0) return kCannotWrite;  // RunMain says so
    PrintError(fmt::format("internal error: {}", error.what()));
  } catch (const std::bad_alloc&) {
    PrintError("out of memory");
  } catch (const std::exception& error) {
    PrintError(fmt::format("internal error: {}", error.what()));
  } catch (...) {
    PrintError("internal error");
  }
  return kInternalError;
}

}  // namespace

int RunMain(int argc, char** argv) {
  std::locale::global(std::locale::classic());
  StartLogging(argc > 0 ? argv[0] : "hexcal");
  CatchInterrupts();
  const int status = Guarded(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
  // A full disk or a closed pipe shows only now.
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    PrintError(fmt::format("cannot write to standard output: {}", std::strerror(errno)));
    return status == kDone ? kCannotWrite : status;
  }
  return status;
}

}  // namespace hexcal
