// SPDX-License-Identifier: BSD-3-Clause
// The file of a history: what it keeps, and that no change of it stays hidden. That a kill loses
// nothing is tested in history_kill_test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <set>

#include "config/input_error.h"
#include "report/history/check.h"
#include "testing/histories.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::AnyRecord;
using ::hexcal::testing::Append;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

// A second program at the file, which knows nothing of hexcal.
class Intruder {
 public:
  explicit Intruder(const std::string& path) {
    EXPECT_EQ(sqlite3_open(path.c_str(), &handle_), SQLITE_OK);
    Try("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
  }
  ~Intruder() { sqlite3_close(handle_); }

  int Try(const std::string& sql) {
    return sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  }

  // With the triggers out of the way, and put back as they were.
  int TryWithoutTriggers(const std::string& sql) {
    std::vector<std::string> names, statements;
    sqlite3_stmt* select = nullptr;
    sqlite3_prepare_v2(handle_,
                       "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' ORDER BY rowid",
                       -1,
                       &select,
                       nullptr);
    while (sqlite3_step(select) == SQLITE_ROW) {
      names.push_back(reinterpret_cast<const char*>(sqlite3_column_text(select, 0)));
      statements.push_back(reinterpret_cast<const char*>(sqlite3_column_text(select, 1)));
    }
    sqlite3_finalize(select);
    EXPECT_EQ(names.size(), 3u);
    for (const std::string& name : names) EXPECT_EQ(Try("DROP TRIGGER " + name), SQLITE_OK);
    const int result = Try(sql);
    for (const std::string& statement : statements) EXPECT_EQ(Try(statement), SQLITE_OK);
    return result;
  }

 private:
  sqlite3* handle_ = nullptr;
};

std::string Quoted(const std::string& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex = "CAST(x'";
  for (const unsigned char c : bytes) hex += {kDigits[c / 16], kDigits[c % 16]};
  return hex + "' AS TEXT)";
}

HistoryCheck Check(const std::string& path, const std::string& head = {}) {
  return CheckHistory(ReadHistory(path), head);
}

std::string Make(const TemporaryFolder& folder, int records) {
  const std::string path = folder.Path("h.sqlite");
  for (int i = 0; i < records; ++i) Append(path, AnyRecord(i % 2 == 0 ? "even" : "odd", i));
  return path;
}

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
}

TEST(HistoryRecord, IsNotWhatIsNoRecord) {
  const std::string text = CanonicalText(AnyRecord("d", 3));
  for (const std::string& other :
       {std::string(), std::string("{}"), std::string("[1]"), text + "x", text.substr(1)})
    EXPECT_FALSE(ParseRecord(other)) << other;
  std::string longer = text;
  longer.replace(longer.find("0.2"), 3, "1e9999");
  EXPECT_FALSE(ParseRecord(longer));
  std::string stretched = text;
  stretched.replace(stretched.find("\"quaternion\":[1.0"), 17, "\"quaternion\":[2.0");
  EXPECT_FALSE(ParseRecord(stretched));
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
  const std::string path = Make(folder, 2);
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
  const std::string path = Make(folder, 3);
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

// Columns by the bytes of their text; number by its digits.
TEST(History, FindsEverySingleByteChangeOfARecord) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 3);
  const std::string original = folder.Read("h.sqlite");
  auto rng = SeededByTest();
  const std::vector<std::string> columns = {"previous",
                                            "hash",
                                            "text",
                                            "written",
                                            "dataset",
                                            "command",
                                            "user",
                                            "host",
                                            "operator",
                                            "number"};
  const std::vector<StoredRecord> rows = ReadHistory(path);
  int found = 0;
  constexpr int kChanges = 1000;
  for (int i = 0; i < kChanges; ++i) {
    folder.Write("h.sqlite", original);
    const StoredRecord& row = rows[rng() % rows.size()];
    // Every other change is one of the text, which has nearly all the bytes.
    const std::string& column = i % 2 == 0 ? columns[2] : columns[rng() % columns.size()];
    const auto repeated = std::find(kRepeated.begin(), kRepeated.end(), column);
    std::string value = column == "previous" ? row.previous
                        : column == "hash"   ? row.hash
                        : column == "text"   ? row.text
                        : column == "number" ? std::to_string(row.number)
                                             : row.repeated[repeated - kRepeated.begin()];
    char& byte = value[rng() % value.size()];
    if (column == "number")
      byte = static_cast<char>('4' + rng() % 6);  // another record's number cannot be taken
    else
      byte = static_cast<char>(byte ^ (1 + rng() % 255));
    const std::string sql = "UPDATE record SET " + column + " = " +
                            (column == "number" ? value : Quoted(value)) +
                            " WHERE number = " + std::to_string(row.number);
    ASSERT_EQ(Intruder(path).TryWithoutTriggers(sql), SQLITE_OK) << sql;
    const HistoryCheck check = Check(path);
    const bool names_it = std::any_of(
        check.problems.begin(), check.problems.end(), [&](const HistoryProblem& problem) {
          return problem.number == row.number || column == "number";
        });
    EXPECT_TRUE(names_it) << column << " of record " << row.number;
    if (names_it) ++found;
  }
  EXPECT_EQ(found, kChanges);
}

TEST(History, FindsAValueOfAnotherType) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 1);
  // STRICT refuses it; a file that says otherwise of its table is refused as a whole.
  EXPECT_NE(Intruder(path).TryWithoutTriggers("UPDATE record SET user = CAST(user AS BLOB)"),
            SQLITE_OK);
  Intruder intruder(path);
  intruder.Try("PRAGMA writable_schema = ON");
  ASSERT_EQ(intruder.Try("UPDATE sqlite_master SET sql = replace(sql, ') STRICT', ')') "
                         "WHERE name = 'record'"),
            SQLITE_OK);
  EXPECT_THROW(Check(path), InputError);
}

// A byte of the file changed: the file is refused, or the change found, or no record differs.
TEST(History, NoChangedByteOfTheFileChangesARecordUnseen) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 3);
  const std::string original = folder.Read("h.sqlite");
  std::vector<std::string> texts;
  for (const StoredRecord& row : ReadHistory(path)) texts.push_back(row.text);
  auto rng = SeededByTest();
  int refused = 0, found = 0, harmless = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string changed = original;
    // The header, in which most bytes mean something, more often than by its size.
    const std::size_t at = i % 5 == 0 ? rng() % 100 : rng() % changed.size();
    changed[at] = static_cast<char>(changed[at] ^ (1 + rng() % 255));
    folder.Write("h.sqlite", changed);
    try {
      const std::vector<StoredRecord> rows = ReadHistory(path);
      if (!CheckHistory(rows).is_intact()) {
        ++found;
        continue;
      }
      ++harmless;
      ASSERT_EQ(rows.size(), texts.size()) << at;
      for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k].text, texts[k]) << at;
    } catch (const InputError&) {
      ++refused;
    } catch (const OutputError&) {  // SQLite cannot tell a disk's fault from a changed header
      ++refused;
    }
    for (const char* side : {"-wal", "-shm", "-journal"}) unlink((path + side).c_str());
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(found, 200);
  EXPECT_GT(harmless, 10);
}

TEST(History, FindsRecordsRemovedInsertedAndReordered) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 4);
  const std::string original = folder.Read("h.sqlite");
  const std::string swap =
      "UPDATE record SET number = 99 WHERE number = 2; UPDATE record SET number = 2 WHERE number = "
      "3; UPDATE record SET number = 3 WHERE number = 99";
  const std::string insert =
      "UPDATE record SET number = -4 WHERE number = 4; UPDATE record SET number = -3 WHERE number "
      "= 3; UPDATE record SET number = 5 WHERE number = -4; UPDATE record SET number = 4 WHERE "
      "number = -3; INSERT INTO record SELECT 3, previous, hash, text, written, dataset, command, "
      "user, host, operator FROM record WHERE number = 2";
  for (const std::string& sql :
       {std::string("DELETE FROM record WHERE number = 1"),
        std::string("DELETE FROM record WHERE number = 2"),
        // and closed up
        std::string("DELETE FROM record WHERE number = 2; UPDATE record SET number = number - 1 "
                    "WHERE number > 2"),
        swap,
        insert}) {
    folder.Write("h.sqlite", original);
    ASSERT_EQ(Intruder(path).TryWithoutTriggers(sql), SQLITE_OK) << sql;
    EXPECT_FALSE(Check(path).is_intact()) << sql;
  }
}

TEST(History, AHeadFindsACutOffEnd) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 4);
  const std::vector<StoredRecord> rows = ReadHistory(path);
  EXPECT_TRUE(Check(path, rows[3].hash).is_intact());
  EXPECT_EQ(Check(path, rows[3].hash).after_head, 0);
  // Records may have come since.
  EXPECT_TRUE(Check(path, rows[1].hash).is_intact());
  EXPECT_EQ(Check(path, rows[1].hash).after_head, 2);
  ASSERT_EQ(Intruder(path).TryWithoutTriggers("DELETE FROM record WHERE number > 2"), SQLITE_OK);
  EXPECT_TRUE(Check(path).is_intact());
  EXPECT_TRUE(Check(path, rows[1].hash).is_intact());
  EXPECT_FALSE(Check(path, rows[3].hash).is_intact());
  EXPECT_FALSE(Check(path, rows[2].hash).is_intact());
}

// Every hash from the change on written anew: only a head that somebody else holds can tell.
TEST(History, AHeadFindsAForger) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 3);
  const std::string head = ReadHistory(path).back().hash;
  const std::string forged = folder.Path("forged.sqlite");
  for (int i = 0; i < 3; ++i) {
    HistoryRecord record = AnyRecord(i % 2 == 0 ? "even" : "odd", i);
    if (i == 1) record.author.operator_name = "somebody else";
    Append(forged, record);
  }
  EXPECT_TRUE(Check(forged).is_intact());
  EXPECT_FALSE(Check(forged, head).is_intact());
}

// One record written anew with its own hash: the next one, which has the old hash, tells; and where
// there is none, what the record says of the one before.
TEST(History, FindsARecordThatWasWrittenAnewWithItsHash) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 3);
  const std::string original = folder.Read("h.sqlite");
  const std::vector<StoredRecord> rows = ReadHistory(path);
  const auto write_anew = [&](const HistoryRecord& record) {
    const std::string text = CanonicalText(record);
    folder.Write("h.sqlite", original);
    ASSERT_EQ(Intruder(path).TryWithoutTriggers(
                  "UPDATE record SET text = " + Quoted(text) + ", hash = '" + Sha256(text) +
                  "' WHERE number = " + std::to_string(record.number)),
              SQLITE_OK);
  };
  HistoryRecord second = *rows[1].record;
  second.poses += 1;
  write_anew(second);
  HistoryCheck check = Check(path);
  ASSERT_EQ(check.problems.size(), 1u);
  EXPECT_EQ(check.problems[0].number, 3);
  EXPECT_THAT(check.problems[0].what, HasSubstr("does not follow the record before it"));
  HistoryRecord third = *rows[2].record;
  third.previous = rows[0].hash;
  write_anew(third);
  check = Check(path);
  ASSERT_EQ(check.problems.size(), 1u);
  EXPECT_THAT(check.problems[0].what, HasSubstr("column previous"));
}

TEST(History, SaysWhichRecordIsMissing) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 4);
  ASSERT_EQ(Intruder(path).TryWithoutTriggers("DELETE FROM record WHERE number = 2"), SQLITE_OK);
  const HistoryCheck check = Check(path);
  ASSERT_EQ(check.problems.size(), 2u);
  EXPECT_EQ(check.problems[0].number, 3);
  EXPECT_EQ(check.problems[0].what, "found where record 2 should be");
}

TEST(History, IsNotAppendedToWhereItsEndWasChanged) {
  const TemporaryFolder folder;
  const std::string path = Make(folder, 2);
  RequireAppendable(path);
  ASSERT_EQ(
      Intruder(path).TryWithoutTriggers(
          "UPDATE record SET text = replace(text, 'nonlinear', 'nonlinfar') WHERE number = 2"),
      SQLITE_OK);
  EXPECT_THROW(RequireAppendable(path), InputError);
  EXPECT_THROW(Append(path, AnyRecord("d", 5)), InputError);
  EXPECT_EQ(ReadHistory(path).size(), 2u);
}

TEST(History, RefusesForeignFilesAndLeavesThemAlone) {
  const TemporaryFolder folder;
  const std::string text = folder.Write("text", "not a database, but longer than a header of one");
  const std::string other = folder.Path("other");
  Intruder(other).Try("CREATE TABLE record (number, text)");
  const std::string extended = Make(folder, 1);
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
  const std::string path = Make(folder, 1);
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
