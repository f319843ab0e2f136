// SPDX-License-Identifier: BSD-3-Clause
#include "config/database.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "config/input_error.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::TemporaryFolder;

const DatabaseKind kKind = {
    "hxts", 3, "a test's database", "CREATE TABLE things (id INTEGER PRIMARY KEY, x REAL, t TEXT)"};

std::int64_t Count(Database* database) {
  Statement statement(database, "SELECT count(*) FROM things");
  EXPECT_TRUE(statement.Step());
  return statement.Integer(0);
}

void Insert(Database* database, double x) {
  Statement(database, "INSERT INTO things (x, t) VALUES (?, ?)").Bind(1, x).Bind(2, "t").Step();
}

TEST(Database, KeepsValuesToTheLastBit) {
  const TemporaryFolder folder;
  const double tenth = 0.1, tiny = 5e-324;
  const std::string text = std::string("a\0b", 3) + "\xc3\xa9";
  {
    Database database(folder.Path("db"), kKind, Database::Access::kWrite);
    Statement statement(&database, "INSERT INTO things VALUES (?, ?, ?)");
    statement.Bind(1, std::numeric_limits<std::int64_t>::max()).Bind(2, tenth).Bind(3, text).Step();
    statement.Reset();
    statement.Bind(1, 1).Bind(2, tiny).BindNull(3).Step();
    statement.Reset();
    statement.Bind(1, 2).Bind(2, std::nan("")).Step();
  }
  Database database(folder.Path("db"), kKind, Database::Access::kRead);
  Statement statement(&database, "SELECT id, x, t FROM things ORDER BY id");
  ASSERT_TRUE(statement.Step());
  EXPECT_EQ(statement.Real(1), tiny);
  EXPECT_TRUE(statement.IsNull(2));
  ASSERT_TRUE(statement.Step());
  EXPECT_TRUE(statement.IsNull(1));
  EXPECT_TRUE(std::isnan(statement.Real(1)));
  ASSERT_TRUE(statement.Step());
  EXPECT_EQ(statement.Integer(0), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(statement.Real(1), tenth);
  EXPECT_EQ(statement.Text(2), text);
  EXPECT_FALSE(statement.Step());
}

TEST(Database, BearsItsMarkInTheFirstBytes) {
  const TemporaryFolder folder;
  { Database database(folder.Path("db"), kKind, Database::Access::kWrite); }
  EXPECT_EQ(folder.Read("db").substr(68, 4), "hxts");
}

TEST(Database, ATransactionIsAllOrNothing) {
  const TemporaryFolder folder;
  Database database(folder.Path("db"), kKind, Database::Access::kWrite);
  {
    Transaction transaction(&database);
    Insert(&database, 1.0);
  }
  EXPECT_EQ(Count(&database), 0);
  {
    Transaction transaction(&database);
    Insert(&database, 1.0);
    transaction.Commit();
  }
  EXPECT_EQ(Count(&database), 1);
}

TEST(Database, OpensAgainWhatItMade) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    Database database(folder.Path("db"), kKind, Database::Access::kWrite);
    EXPECT_EQ(Count(&database), i);
    Insert(&database, i);
  }
}

// A file that was made but not filled, as a kill may leave it, is a new one.
TEST(Database, FillsAnEmptyFile) {
  const TemporaryFolder folder;
  Database database(folder.Write("db", ""), kKind, Database::Access::kWrite);
  EXPECT_EQ(Count(&database), 0);
}

TEST(Database, RefusesWhatIsNotItsOwn) {
  const TemporaryFolder folder;
  const std::string text = folder.Write("text", std::string(5000, 'x'));
  {
    Database database(
        folder.Path("other"), {"hxot", 1, "x", "CREATE TABLE a (b)"}, Database::Access::kWrite);
  }
  {
    Database database(
        folder.Path("later"), {"hxts", 4, "x", "CREATE TABLE a (b)"}, Database::Access::kWrite);
  }
  const std::string other = folder.Read("other");
  for (const auto access : {Database::Access::kRead, Database::Access::kWrite})
    for (const char* name : {"text", "other", "later"})
      EXPECT_THROW(Database(folder.Path(name), kKind, access), InputError) << name;
  EXPECT_EQ(folder.Read("other"), other);
  EXPECT_EQ(folder.Read("text"), std::string(5000, 'x'));
  EXPECT_THROW(Database(folder.Path("missing"), kKind, Database::Access::kRead), InputError);
  EXPECT_EQ(folder.Names().size(), 3u);
}

TEST(Database, SaysWhereItCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(Database(folder.Path("no/db"), kKind, Database::Access::kWrite), OutputError);
}

}  // namespace
}  // namespace hexcal
