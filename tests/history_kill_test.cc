// SPDX-License-Identifier: BSD-3-Clause
// A process that appends is killed at any moment: what it was told to be on the disk is there, and
// the chain is whole. SIGKILL cannot show what a power failure does; for that the file is opened
// with synchronous=EXTRA.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>
#include <thread>

#include "report/history/check.h"
#include "testing/histories.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::AnyRecord;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::TemporaryFolder;

constexpr int kKills = 1000;
constexpr int kKillsAFile = 25;  // then a new file: its making is interrupted, too

[[noreturn]] void AppendForEver(const std::string& path, int reports) {
  for (int i = 0;; ++i) {
    PendingRecord pending(path, AnyRecord("d", i));
    const long number = pending.record().number;
    pending.Commit();
    if (write(reports, &number, sizeof number) != sizeof number) _exit(1);
  }
}

// A child that appends, and what it reports to be on the disk.
class Child {
 public:
  explicit Child(const std::string& path) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ == 0) {
      close(ends[0]);
      AppendForEver(path, ends[1]);
    }
    close(ends[1]);
    reports_ = ends[0];
  }
  ~Child() { close(reports_); }

  // Waits for the next report: the number of a record.
  void Wait() {
    long number = 0;
    if (read(reports_, &number, sizeof number) == sizeof number) last_ = number;
  }

  // The number of the last record that was reported; 0: none.
  long Kill() {
    kill(process_, SIGKILL);
    int status = 0;
    waitpid(process_, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    long number = 0;
    while (read(reports_, &number, sizeof number) == sizeof number) last_ = number;
    return last_;
  }

 private:
  pid_t process_ = -1;
  int reports_ = -1;
  long last_ = 0;
};

// Every other child is killed in its first record, the others in their second: after a share of
// the time that a record took the time before.
TEST(HistoryKill, LosesNoCommittedRecord) {
  using Clock = std::chrono::steady_clock;
  auto rng = SeededByTest();
  Clock::duration of_a_record = std::chrono::milliseconds(5);
  long records = 0;
  for (int file = 0; file < kKills / kKillsAFile; ++file) {
    const TemporaryFolder folder;
    const std::string path = folder.Path("h.sqlite");
    long known = 0;
    int kills_since = 0;  // the file was read
    for (int kill = 0; kill < kKillsAFile; ++kill) {
      Child child(path);
      if (kill % 2 == 1) {
        const Clock::time_point start = Clock::now();
        child.Wait();
        of_a_record = Clock::now() - start;
      }
      std::this_thread::sleep_for(testing::Uniform(rng, 0.0, 1.2) * of_a_record);
      known = std::max(known, child.Kill());
      ++kills_since;
      if (known == 0) continue;  // the file may not be there yet
      const std::vector<StoredRecord> rows = ReadHistory(path);
      ASSERT_GE(static_cast<long>(rows.size()), known) << "file " << file << " kill " << kill;
      // One more for each kill may be there: killed between the commit and its report.
      ASSERT_LE(static_cast<long>(rows.size()), known + kills_since);
      ASSERT_TRUE(CheckHistory(rows).is_intact()) << "file " << file << " kill " << kill;
      known = static_cast<long>(rows.size());
      kills_since = 0;
    }
    records += known;
  }
  EXPECT_GE(records, kKills / kKillsAFile * (kKillsAFile / 2));
}

}  // namespace
}  // namespace hexcal
