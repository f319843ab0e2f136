// SPDX-License-Identifier: BSD-3-Clause
// The file of a history: what it keeps. That no change of it stays hidden is tested in
// history_tamper_test, that a kill loses nothing in history_kill_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <set>

#include "config/input_error.h"
#include "report/history/trend.h"
#include "testing/history_files.h"

namespace hexcal {
namespace {

using ::hexcal::testing::AnyRecord;
using ::hexcal::testing::Append;
using ::hexcal::testing::Check;
using ::hexcal::testing::Intruder;
using ::hexcal::testing::MakeHistory;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(HistoryRecord, TextReadsBackToTheLastBit) {
  HistoryRecord record = AnyRecord("d", 3);
  record.number = 7;
  record.previous = std::string(kNoHash);
  record.known.mounts.world_from_base.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()));
  record.noise_scale = std::numeric_limits<double>::quiet_NaN();
  record.known.determined[4] = false;
  const std::string text = CanonicalText(record);
  const auto read = ParseRecord(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(CanonicalText(*read), text);
  EXPECT_EQ(read->known.mounts.platform_from_tool.translation.z(), 1.0 / 3.0);
  EXPECT_EQ(read->known.mounts.world_from_base.rotation.coeffs(),
            record.known.mounts.world_from_base.rotation.coeffs());
  EXPECT_EQ(read->known.covariance(0, 1), 1e-11);
  EXPECT_FALSE(read->known.determined[4]);
  EXPECT_TRUE(read->known.determined[5]);
  EXPECT_EQ(read->warnings, record.warnings);
  EXPECT_EQ(read->settings, record.settings);
  EXPECT_EQ(read->revision, "0123456789ab");
}

TEST(HistoryRecord, OlderOnesHaveNoRevision) {
  HistoryRecord record = AnyRecord("d", 3);
  record.revision.clear();
  const std::string text = CanonicalText(record);
  EXPECT_THAT(text, Not(HasSubstr("revision")));
  const auto read = ParseRecord(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->revision, "");
  EXPECT_EQ(CanonicalText(*read), text);
}

TEST(HistoryRecord, IsNotWhatIsNoRecord) {
  const std::string text = CanonicalText(AnyRecord("d", 3));
  for (const std::string& other :
       {std::string(), std::string("{}"), std::string("[1]"), text + "x", text.substr(1)})
    EXPECT_FALSE(ParseRecord(other)) << other;
  std::string longer = text;
  longer.replace(longer.find("0.2"), 3, "1e9999");
  EXPECT_FALSE(ParseRecord(longer));
  HistoryRecord impossible = AnyRecord("d", 3);
  impossible.known.covariance(0, 0) = -impossible.known.covariance(0, 0);
  EXPECT_FALSE(ParseRecord(CanonicalText(impossible)));
  std::string stretched = text;
  stretched.replace(stretched.find("\"quaternion\":[1.0"), 17, "\"quaternion\":[2.0");
  EXPECT_FALSE(ParseRecord(stretched));
}

TEST(HistoryRecord, WayNamesWhatMakesTheEstimateAnother) {
  HistoryRecord record = AnyRecord("d", 3);
  record.solver = "nonlinear", record.residual = "pose", record.error = "";
  record.effects.clear();
  record.settings = {{"loss", "none"}, {"loss_scale", "0"}, {"outliers", "report"}};
  EXPECT_EQ(WayOf(record), "nonlinear by poses");
  record.settings = {{"loss", "huber"}, {"loss_scale", "0"}, {"outliers", "report"}};
  EXPECT_EQ(WayOf(record), "nonlinear by poses; loss huber");
  record.settings = {{"loss", "tukey"}, {"loss_scale", "6"}, {"outliers", "reject"}};
  record.effects = {"leg_gain"};
  EXPECT_EQ(WayOf(record),
            "nonlinear by poses with leg_gain; loss tukey at 6 sigmas; without outliers");
}

TEST(History, KeepsRecordsInAChain) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("h.sqlite");
  std::vector<std::string> hashes;
  for (int i = 0; i < 3; ++i) hashes.push_back(Append(path, AnyRecord("d", i)));
  const std::vector<StoredRecord> rows = ReadHistory(path);
  ASSERT_EQ(rows.size(), 3u);
  std::string before(kNoHash);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].number, i + 1);
    EXPECT_EQ(rows[i].hash, hashes[i]);
    EXPECT_EQ(Sha256(rows[i].text), hashes[i]);
    EXPECT_EQ(rows[i].record->previous, before);
    EXPECT_EQ(rows[i].record->readings_sha256, AnyRecord("d", i).readings_sha256);
    before = hashes[i];
  }
  const HistoryCheck check = CheckHistory(rows);
  EXPECT_TRUE(check.is_intact());
  EXPECT_EQ(check.head, hashes[2]);
}

TEST(History, HasNothingOfARecordThatWasNotCommitted) {
  const TemporaryFolder folder;
  const std::string path = MakeHistory(folder, 2);
  {
    const PendingRecord pending(path, AnyRecord("d", 9));
    EXPECT_EQ(pending.record().number, 3);
    EXPECT_EQ(pending.Before(10).size(), 0u);
  }
  EXPECT_EQ(ReadHistory(path).size(), 2u);
  const PendingRecord pending(path, AnyRecord("even", 9));
  EXPECT_EQ(pending.Before(10).size(), 1u);
  EXPECT_EQ(pending.Before(10)[0].number, 1);
}

TEST(History, TriggersRefuseEveryChange) {
  const TemporaryFolder folder;
  const std::string path = MakeHistory(folder, 3);
  Intruder intruder(path);
  const std::string columns =
      "previous, hash, text, written, dataset, command, user, host, operator";
  for (const std::string& sql :
       {std::string("UPDATE record SET user = 'x'"),
        std::string("DELETE FROM record WHERE number = 3"),
        std::string("DELETE FROM record"),
        "INSERT OR REPLACE INTO record SELECT 2, " + columns + " FROM record WHERE number = 3",
        "INSERT INTO record SELECT 9, " + columns + " FROM record WHERE number = 3",
        std::string("UPDATE OR REPLACE record SET number = 1")})
    EXPECT_NE(intruder.Try(sql), SQLITE_OK) << sql;
  EXPECT_TRUE(Check(path).is_intact());
  EXPECT_EQ(ReadHistory(path).size(), 3u);
}

TEST(History, RefusesForeignFilesAndLeavesThemAlone) {
  const TemporaryFolder folder;
  const std::string text = folder.Write("text", "not a database, but longer than a header of one");
  const std::string other = folder.Path("other");
  Intruder(other).Try("CREATE TABLE record (number, text)");
  const std::string extended = MakeHistory(folder, 1);
  Intruder(extended).Try("CREATE TABLE more (x)");
  const std::string bytes = folder.Read("other");
  for (const std::string& path : {text, other, extended}) {
    EXPECT_THROW(ReadHistory(path), InputError) << path;
    EXPECT_THROW(RequireAppendable(path), InputError) << path;
    EXPECT_THROW(Append(path, AnyRecord("d", 1)), InputError) << path;
  }
  EXPECT_EQ(folder.Read("other"), bytes);
  EXPECT_THROW(ReadHistory(folder.Path("none")), InputError);
  EXPECT_THROW(ReadHistory(folder.Write("empty", "")), InputError);
  EXPECT_EQ(folder.Read("empty"), "");
}

TEST(History, SaysWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  folder.Write("file", "");
  EXPECT_THROW(RequireAppendable(folder.Path("file/h.sqlite")), OutputError);
  EXPECT_THROW(Append(folder.Path("file/h.sqlite"), AnyRecord("d", 1)), OutputError);
  RequireAppendable(folder.Path("new/folder/h.sqlite"));
  EXPECT_EQ(folder.Names().size(), 1u);
  Append(folder.Path("new/folder/h.sqlite"), AnyRecord("d", 1));
  EXPECT_TRUE(Check(folder.Path("new/folder/h.sqlite")).is_intact());
}

TEST(History, SaysThatAnotherFileTookItsPlace) {
  const TemporaryFolder folder;
  const std::string path = MakeHistory(folder, 1);
  PendingRecord pending(path, AnyRecord("d", 2));
  unlink(path.c_str());
  folder.Write("h.sqlite", "the results of something else");
  EXPECT_THROW(pending.Commit(), OutputError);
}

TEST(History, HostileTextsAreOnlyTexts) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("h.sqlite");
  const std::vector<std::string> hostile = {"'); DROP TABLE record; --",
                                            std::string("a\0b", 3),
                                            "\xff\xfe not UTF-8 \xc3",
                                            "</script><script>alert(1)</script>",
                                            "\x1b[2J%s%n\n\r\t\"\\",
                                            "",
                                            std::string(100000, 'x')};
  for (const std::string& text : hostile) {
    HistoryRecord record = AnyRecord("d", 1);
    record.author = {text, text, text};
    record.dataset = record.command = record.version = text;
    record.inputs = {{text, text}};
    record.settings = {{text, text}};
    record.warnings = record.effects = {text};
    Append(path, record);
  }
  const std::vector<StoredRecord> rows = ReadHistory(path);
  ASSERT_EQ(rows.size(), hostile.size());
  EXPECT_TRUE(CheckHistory(rows).is_intact());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 2) continue;  // the bytes that are no UTF-8 were replaced
    EXPECT_EQ(rows[i].record->author.operator_name, hostile[i]);
    EXPECT_EQ(rows[i].repeated[1], hostile[i]);
  }
  EXPECT_THAT(rows[2].record->dataset, HasSubstr("\xef\xbf\xbd not UTF-8"));
}

TEST(History, TwoProcessesAppendAtOnce) {
  const TemporaryFolder folder;
  const std::string path = folder.Path("h.sqlite");
  constexpr int kEach = 40;
  std::vector<pid_t> children;
  int start[2];  // closed: both begin
  ASSERT_EQ(pipe(start), 0);
  for (int child = 0; child < 2; ++child) {
    const pid_t pid = fork();
    if (pid == 0) {
      try {
        close(start[1]);
        char none;
        if (read(start[0], &none, 1) != 0) _exit(1);
        for (int i = 0; i < kEach; ++i) {
          PendingRecord pending(path, AnyRecord(child == 0 ? "a" : "b", i));
          usleep(500);  // as results are written meanwhile
          pending.Commit();
        }
      } catch (const std::exception&) {
        _exit(1);
      }
      _exit(0);
    }
    children.push_back(pid);
  }
  close(start[0]);
  close(start[1]);
  for (const pid_t child : children) {
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  const std::vector<StoredRecord> rows = ReadHistory(path);
  EXPECT_EQ(rows.size(), 2u * kEach);
  EXPECT_TRUE(CheckHistory(rows).is_intact());
  std::set<std::string> readings[2];
  for (const StoredRecord& row : rows)
    readings[row.record->dataset == "a" ? 0 : 1].insert(row.record->readings_sha256);
  for (const auto& some : readings) EXPECT_EQ(some.size(), static_cast<std::size_t>(kEach));
}

}  // namespace
}  // namespace hexcal
