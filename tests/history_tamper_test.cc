// SPDX-License-Identifier: BSD-3-Clause
// No change of a history's file stays hidden.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/input_error.h"
#include "testing/history_files.h"

namespace hexcal {
namespace {

using ::hexcal::testing::AnyRecord;
using ::hexcal::testing::Append;
using ::hexcal::testing::Check;
using ::hexcal::testing::Intruder;
using ::hexcal::testing::MakeHistory;
using ::hexcal::testing::QuotedSql;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

// Columns by the bytes of their text; number by its digits.
TEST(History, FindsEverySingleByteChangeOfARecord) {
  const TemporaryFolder folder;
  const std::string path = MakeHistory(folder, 3);
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
                            (column == "number" ? value : QuotedSql(value)) +
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
  const std::string path = MakeHistory(folder, 1);
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
  const std::string path = MakeHistory(folder, 3);
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
  const std::string path = MakeHistory(folder, 4);
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
  const std::string path = MakeHistory(folder, 4);
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
  const std::string path = MakeHistory(folder, 3);
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
  const std::string path = MakeHistory(folder, 3);
  const std::string original = folder.Read("h.sqlite");
  const std::vector<StoredRecord> rows = ReadHistory(path);
  const auto write_anew = [&](const HistoryRecord& record) {
    const std::string text = CanonicalText(record);
    folder.Write("h.sqlite", original);
    ASSERT_EQ(Intruder(path).TryWithoutTriggers(
                  "UPDATE record SET text = " + QuotedSql(text) + ", hash = '" + Sha256(text) +
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
  const std::string path = MakeHistory(folder, 4);
  ASSERT_EQ(Intruder(path).TryWithoutTriggers("DELETE FROM record WHERE number = 2"), SQLITE_OK);
  const HistoryCheck check = Check(path);
  ASSERT_EQ(check.problems.size(), 2u);
  EXPECT_EQ(check.problems[0].number, 3);
  EXPECT_EQ(check.problems[0].what, "found where record 2 should be");
}

TEST(History, IsNotAppendedToWhereItsEndWasChanged) {
  const TemporaryFolder folder;
  const std::string path = MakeHistory(folder, 2);
  RequireAppendable(path);
  ASSERT_EQ(
      Intruder(path).TryWithoutTriggers(
          "UPDATE record SET text = replace(text, 'nonlinear', 'nonlinfar') WHERE number = 2"),
      SQLITE_OK);
  EXPECT_THROW(RequireAppendable(path), InputError);
  EXPECT_THROW(Append(path, AnyRecord("d", 5)), InputError);
  EXPECT_EQ(ReadHistory(path).size(), 2u);
}

}  // namespace
}  // namespace hexcal
