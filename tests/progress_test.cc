// SPDX-License-Identifier: BSD-3-Clause
#include "apps/progress.h"

#include "apps/message.h"

#include <gtest/gtest.h>

#include <string>

namespace hexcal {
namespace {

// A terminal whose clock stands still until it is told to move on.
struct FakeTerminal {
  double now = 100.0;
  std::string text;

  ProgressScreen Screen(bool is_terminal = true) {
    return {is_terminal, [this] { return now; }, [this](std::string_view more) { text += more; }};
  }
};

TEST(Progress, AppearsOnlyAfterTwoSeconds) {
  FakeTerminal terminal;
  Progress progress("poses", false, terminal.Screen());
  terminal.now += 2.0;
  progress.Update(1, 4);
  EXPECT_EQ(terminal.text, "");
  terminal.now += 0.01;
  progress.Update(2, 4);
  EXPECT_EQ(terminal.text, "\rposes [###############...............] 2/4, 60/min, 2 s left\x1b[K");
}

// 40 of 100 in 10 s, then in 1000 s, then 1 of 100 in 1000 s.
TEST(Progress, SaysRateAndTimeLeft) {
  const auto shown = [](double seconds, long done) {
    FakeTerminal terminal;
    Progress progress("poses", false, terminal.Screen());
    terminal.now += seconds;
    progress.Update(done, 100);
    return terminal.text;
  };
  EXPECT_NE(shown(10.0, 40).find("40/100, 4/s, 15 s left"), std::string::npos) << shown(10.0, 40);
  EXPECT_NE(shown(1000.0, 40).find("40/100, 2.4/min, 25:00 min left"), std::string::npos);
  EXPECT_NE(shown(1000.0, 1).find("1/100, 3.6/h, 27:30 h left"), std::string::npos);
  EXPECT_NE(shown(10.0, 0).find("0/100\x1b"), std::string::npos);
  EXPECT_NE(shown(10.0, 100).find("100/100\x1b"), std::string::npos);
}

TEST(Message, HasColourOnATerminalThatMayHaveIt) {
  EXPECT_TRUE(IsColoured(true, nullptr, "xterm"));
  EXPECT_TRUE(IsColoured(true, "", "xterm"));
  EXPECT_FALSE(IsColoured(true, "1", "xterm"));
  EXPECT_FALSE(IsColoured(true, nullptr, "dumb"));
  EXPECT_FALSE(IsColoured(true, nullptr, nullptr));
  EXPECT_FALSE(IsColoured(false, nullptr, "xterm"));
}

TEST(Progress, IsWipedAtTheEnd) {
  FakeTerminal terminal;
  {
    Progress progress("poses", false, terminal.Screen());
    terminal.now += 3.0;
    progress.Update(4, 4);
  }
  EXPECT_EQ(terminal.text, "\rposes [##############################] 4/4\x1b[K\r\x1b[K");
}

TEST(Progress, ShortWorkLeavesNothing) {
  FakeTerminal terminal;
  {
    Progress progress("poses", false, terminal.Screen());
    progress.Update(4, 4);
  }
  EXPECT_EQ(terminal.text, "");
}

TEST(Progress, IsRedrawnAtMostTenTimesASecond) {
  FakeTerminal terminal;
  Progress progress("poses", false, terminal.Screen());
  terminal.now += 3.0;
  int drawn = 0;
  for (int i = 0; i < 1000; ++i, terminal.now += 0.001) {
    const std::size_t before = terminal.text.size();
    progress.Update(i, 1000);
    drawn += terminal.text.size() > before ? 1 : 0;
  }
  EXPECT_GE(drawn, 9);
  EXPECT_LE(drawn, 10);
}

TEST(Progress, IsSilentWithoutATerminalAndUnderQuiet) {
  FakeTerminal terminal;
  Progress piped("poses", false, terminal.Screen(false));
  Progress quiet("poses", true, terminal.Screen());
  terminal.now += 10.0;
  piped.Update(1, 2);
  quiet.Update(1, 2);
  EXPECT_EQ(terminal.text, "");
}

TEST(Progress, GivesWayToOtherText) {
  FakeTerminal terminal;
  Progress progress("poses", false, terminal.Screen());
  terminal.now += 3.0;
  progress.Update(0, 2);
  terminal.text.clear();
  Progress::ClearVisible();
  EXPECT_EQ(terminal.text, "\r\x1b[K");
  Progress::ClearVisible();
  EXPECT_EQ(terminal.text, "\r\x1b[K");
  progress.Update(1, 2);
  EXPECT_NE(terminal.text.find("1/2"), std::string::npos);
}

TEST(Progress, StaysInItsBoxWhateverTheCount) {
  FakeTerminal terminal;
  Progress progress("poses", false, terminal.Screen());
  terminal.now += 3.0;
  progress.Update(0, 0);
  progress.Update(7, 3);
  EXPECT_EQ(terminal.text, "\rposes [##############################] 3/3\x1b[K");
}

}  // namespace
}  // namespace hexcal
