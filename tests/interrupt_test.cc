// SPDX-License-Identifier: BSD-3-Clause
#include "apps/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::testing::ExitedWithCode;
using ::testing::KilledBySignal;

// Each runs in a process of its own, since the end is what is tested.

TEST(Interrupt, EndsWith128PlusTheSignal) {
  EXPECT_EXIT((CatchInterrupts(), std::raise(SIGINT), _exit(0)), ExitedWithCode(130), "");
  EXPECT_EXIT((CatchInterrupts(), std::raise(SIGTERM), _exit(0)), ExitedWithCode(143), "");
}

TEST(Interrupt, WithoutCatchingItTheSignalKills) {
  EXPECT_EXIT((std::raise(SIGINT), _exit(0)), KilledBySignal(SIGINT), "");
}

TEST(Interrupt, WaitsForTheFileThatIsBeingWritten) {
  const testing::TemporaryFolder folder;
  EXPECT_EXIT(
      {
        CatchInterrupts();
        {
          const WhileWriting no_interrupt;
          std::raise(SIGINT);
          folder.Write("file", "whole");
        }
        folder.Write("next", "too late");
        _exit(0);
      },
      ExitedWithCode(130),
      "");
  EXPECT_EQ(folder.Read("file"), "whole");
  EXPECT_EQ(folder.Names().size(), 1U);
}

TEST(Interrupt, ASignalThatWasIgnoredStaysIgnored) {
  EXPECT_EXIT((std::signal(SIGINT, SIG_IGN), CatchInterrupts(), std::raise(SIGINT), _exit(7)),
              ExitedWithCode(7),
              "");
}

TEST(Interrupt, WritingAgainAfterAFileIsFine) {
  { const WhileWriting first; }
  { const WhileWriting second; }
}

}  // namespace
}  // namespace hexcal
