// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace hexcal {

// A kind of SQLite file of hexcal's. Its first bytes tell it from other programs' files.
struct DatabaseKind {
  std::string_view mark;    // four letters, SQLite's application id
  int version = 1;          // of the schema, SQLite's user version
  std::string_view what;    // "the results of hexcal batch", for messages
  std::string_view schema;  // SQL that makes the tables of a new file
};

// An open SQLite file. What another process does at the same moment is waited for. A change is on
// the disk when its transaction ends: killed at any moment, the file holds all that was finished.
// InputError for a file that is not of this kind, or of a later version, or damaged; OutputError
// where the disk does not take it. For one thread at a time.
class Database {
 public:
  enum class Access { kRead, kWrite };  // kWrite makes the file where there is none
  Database(const std::string& path, const DatabaseKind& kind, Access access);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void Run(const std::string& sql);  // statements without results
  const std::string& path() const { return path_; }

 private:
  friend class Statement;
  void Check(int code) const;
  void CheckKind(const DatabaseKind& kind);
  void Prepare(const DatabaseKind& kind, Access access);
  std::int64_t Number(const std::string& sql);

  std::string path_;
  sqlite3* handle_ = nullptr;
};

std::string DatabaseLibraryVersion();  // of SQLite

// A prepared statement: places are bound from 1, columns are read from 0.
class Statement {
 public:
  Statement(Database* database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& Bind(int place, std::int64_t value);
  Statement& Bind(int place, int value) { return Bind(place, std::int64_t{value}); }
  Statement& Bind(int place, double value);  // NaN: null
  Statement& Bind(int place, std::string_view value);
  Statement& BindNull(int place);

  bool Step();   // true: there is a row to read
  void Reset();  // to be stepped from the beginning; what was bound is forgotten

  bool IsNull(int column) const;
  std::int64_t Integer(int column) const;
  double Real(int column) const;  // null: NaN
  std::string Text(int column) const;

 private:
  Database* database_;
  sqlite3_stmt* handle_ = nullptr;
};

// All of the changes until Commit, or none.
class Transaction {
 public:
  explicit Transaction(Database* database);
  ~Transaction();  // rolls back what was not committed
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit();

 private:
  Database* database_;
  bool open_ = true;
};

}  // namespace hexcal
