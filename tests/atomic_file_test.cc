// SPDX-License-Identifier: BSD-3-Clause
// Not covered: a crash or power failure between the steps, and an fsync that fails.
#include "config/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "config/input_error.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::TemporaryFolder;
using Names = std::vector<std::string>;

template <typename Action>
std::string OutputErrorText(Action&& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "(no exception)";
}

std::string WriteError(const std::string& path, std::string_view content) {
  return OutputErrorText([&] { WriteFileAtomically(path, content); });
}

mode_t ModeOf(const std::string& path) {
  struct stat status = {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return status.st_mode & 07777;
}

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("f");
  WriteFileAtomically(path, std::string_view("a\0b\r\n", 5));
  EXPECT_EQ(folder.Read("f"), std::string("a\0b\r\n", 5));
  WriteFileAtomically(path, "");
  EXPECT_EQ(folder.Read("f"), "");
  std::string large;
  large.resize(30'000'000, 'x');
  WriteFileAtomically(path, large);
  EXPECT_TRUE(folder.Read("f") == large);
  EXPECT_EQ(folder.Names(), Names{"f"});
}

TEST(AtomicFile, WritesToTheWorkingFolder) {
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path(""));
  const std::string error = WriteError("f", "x");
  std::filesystem::current_path(before);
  EXPECT_EQ(error, "(no exception)");
  EXPECT_EQ(folder.Read("f"), "x");
  EXPECT_EQ(folder.Names(), Names{"f"});
}

TEST(AtomicFile, ModeIsWhatTheUmaskAllows) {
  const TemporaryFolder folder;
  const mode_t before = umask(027);
  WriteFileAtomically(folder.Path("a"), "x");
  umask(0);
  WriteFileAtomically(folder.Path("b"), "x");
  const mode_t after = umask(before);
  EXPECT_EQ(after, 0u);  // left as it was
  EXPECT_EQ(ModeOf(folder.Path("a")), 0640u);
  EXPECT_EQ(ModeOf(folder.Path("b")), 0666u);
}

TEST(AtomicFile, AMissingFolderIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("no/f");
  EXPECT_EQ(WriteError(path, "x"),
            path + ": creating a temporary file beside it failed: No such file or directory");
  EXPECT_EQ(folder.Names(), Names{});
  const std::string below_file = folder.Write("g", "old") + "/f";
  EXPECT_EQ(WriteError(below_file, "x"),
            below_file + ": creating a temporary file beside it failed: Not a directory");
  EXPECT_EQ(folder.Read("g"), "old");
}

TEST(AtomicFile, AFolderInTheWayIsAnErrorAndStays) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("f");
  MakeFolder(path);
  folder.Write("f/inside", "old");
  EXPECT_EQ(WriteError(path, "x"), path + ": rename to it failed: Is a directory");
  EXPECT_EQ(folder.Read("f/inside"), "old");
  EXPECT_EQ(folder.Names(), Names{"f"});
}

// A limit on the size of files stands in for a full disk: the first write is cut short, the second
// fails.
TEST(AtomicFile, AFullDiskLeavesWhatWasThere) {
  const TemporaryFolder folder;
  const std::string path = folder.Write("f", "old");
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string error = WriteError(path, std::string(5000, 'x'));
  const std::string fits = WriteError(folder.Path("fits"), std::string(1000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, handler);
  EXPECT_EQ(error, path + ": writing failed: File too large");
  EXPECT_EQ(fits, "(no exception)");
  EXPECT_EQ(folder.Read("f"), "old");
  EXPECT_EQ(folder.Names().size(), 2u);  // f and fits
}

TEST(AtomicFile, ReadersSeeOneWholeFileOrTheOther) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("f");
  WriteFileAtomically(path, std::string(100000, 'a'));
  std::atomic<bool> done = false;
  const mode_t before = umask(022);
  umask(before);
  const auto write = [&](char c) {
    for (int i = 0; i < 30; ++i) WriteFileAtomically(path, std::string(100000, c));
  };
  std::thread first(write, 'a'), second([&] {
    write('b');
    done = true;
  });
  int reads = 0, torn = 0;
  do {
    const std::string seen = folder.Read("f");
    const bool whole =
        seen.size() == 100000 && seen.find_first_not_of(seen[0]) == std::string::npos;
    torn += whole ? 0 : 1;
    ++reads;
  } while (!done);
  first.join();
  second.join();
  EXPECT_GT(reads, 0);
  EXPECT_EQ(torn, 0);
  const mode_t after = umask(before);
  umask(before);
  EXPECT_EQ(after, before);
  EXPECT_EQ(folder.Names(), Names{"f"});
}

TEST(MakeFolder, MakesParentsAndIsContentWithWhatIsThere) {
  const TemporaryFolder folder;
  MakeFolder(folder.Path("a/b/c"));
  MakeFolder(folder.Path("a/b/c"));
  MakeFolder(folder.Path("a/d/"));
  EXPECT_TRUE(std::filesystem::is_directory(folder.Path("a/b/c")));
  EXPECT_TRUE(std::filesystem::is_directory(folder.Path("a/d")));
}

TEST(MakeFolder, AFileInTheWayIsAnError) {
  const TemporaryFolder folder;
  const std::string path = folder.Write("f", "old");
  EXPECT_EQ(OutputErrorText([&] { MakeFolder(path); }),
            path + ": making the folder failed: Not a directory");
  EXPECT_EQ(OutputErrorText([&] { MakeFolder(path + "/g"); }),
            path + "/g: making the folder failed: Not a directory");
  EXPECT_EQ(folder.Read("f"), "old");
}

}  // namespace
}  // namespace hexcal
