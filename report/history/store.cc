// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/store.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "config/atomic_file.h"
#include "config/database.h"
#include "config/input_error.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

// Every statement as SQLite keeps it, so that another one shows.
constexpr std::string_view kTable =
    "CREATE TABLE record (number INTEGER PRIMARY KEY, previous TEXT NOT NULL, hash TEXT NOT NULL, "
    "text TEXT NOT NULL, written TEXT NOT NULL, dataset TEXT NOT NULL, command TEXT NOT NULL, "
    "user TEXT NOT NULL, host TEXT NOT NULL, operator TEXT NOT NULL) STRICT";
// INSERT OR REPLACE would delete without asking the trigger for DELETE.
constexpr std::string_view kOnlyAtTheEnd =
    "CREATE TRIGGER only_at_the_end BEFORE INSERT ON record WHEN new.number IS NOT "
    "(SELECT coalesce(max(number), 0) + 1 FROM record) "
    "BEGIN SELECT raise(ABORT, 'a history is only appended to'); END";
constexpr std::string_view kNoUpdate =
    "CREATE TRIGGER no_update BEFORE UPDATE ON record "
    "BEGIN SELECT raise(ABORT, 'a history is only appended to'); END";
constexpr std::string_view kNoDelete =
    "CREATE TRIGGER no_delete BEFORE DELETE ON record "
    "BEGIN SELECT raise(ABORT, 'a history is only appended to'); END";

const std::vector<std::string_view>& Statements() {
  static const std::vector<std::string_view> statements = {
      kTable, kOnlyAtTheEnd, kNoUpdate, kNoDelete};
  return statements;
}

const DatabaseKind& Kind() {
  static const std::string schema = [] {
    std::string all;
    for (const std::string_view statement : Statements()) all += std::string(statement) + ";\n";
    return all;
  }();
  static const DatabaseKind kind = {"hxhi", 1, "a history of hexcal", schema};
  return kind;
}

constexpr const char* kSelect =
    "SELECT number, previous, hash, text, written, dataset, command, user, host, operator, "
    "typeof(number) || typeof(previous) || typeof(hash) || typeof(text) || typeof(written) || "
    "typeof(dataset) || typeof(command) || typeof(user) || typeof(host) || typeof(operator) "
    "FROM record ";
constexpr std::string_view kTypes = "integertexttexttexttexttexttexttexttexttext";

StoredRecord RowOf(const Statement& row) {
  StoredRecord stored;
  stored.number = static_cast<long>(row.Integer(0));
  stored.previous = row.Text(1);
  stored.hash = row.Text(2);
  stored.text = row.Text(3);
  for (std::size_t i = 0; i < kRepeated.size(); ++i)
    stored.repeated[i] = row.Text(4 + static_cast<int>(i));
  stored.has_right_types = row.Text(10) == kTypes;
  stored.record = ParseRecord(stored.text);
  return stored;
}

std::vector<StoredRecord> RowsOf(Statement* statement) {
  std::vector<StoredRecord> rows;
  while (statement->Step()) rows.push_back(RowOf(*statement));
  return rows;
}

void RequireOwnTables(Database* database) {
  Statement statement(database, "SELECT sql FROM sqlite_master ORDER BY rowid");
  std::vector<std::string> found;
  while (statement.Step()) found.push_back(statement.Text(0));
  if (!std::equal(found.begin(), found.end(), Statements().begin(), Statements().end()))
    throw InputError(FileLocation(database->path()),
                     "tables or triggers that hexcal did not make",
                     "a history as hexcal left it");
}

// The last row, which the next one's text refers to, is as it was written.
std::optional<StoredRecord> LastOf(Database* database) {
  Statement statement(database, std::string(kSelect) + "ORDER BY number DESC LIMIT 1");
  std::vector<StoredRecord> rows = RowsOf(&statement);
  if (rows.empty()) return std::nullopt;
  const StoredRecord& last = rows.front();
  if (!last.record || last.record->number != last.number || Sha256(last.text) != last.hash)
    throw InputError(
        FileLocation(database->path()),
        fmt::format("record {} changed after it was written", last.number),
        "a history that nobody has changed ('hexcal history verify' shows all that is)");
  return std::move(rows.front());
}

bool IsThere(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return status.type() != fs::file_type::not_found &&
         !(fs::is_regular_file(status) && fs::file_size(path, ignored) == 0 &&
           !fs::exists(path + "-journal", ignored));
}

fs::path FolderOf(const std::string& path) { return fs::absolute(path).parent_path(); }

std::string NearestFolder(const std::string& path) {
  fs::path folder = FolderOf(path);
  std::error_code ignored;
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  return folder.string();
}

}  // namespace

std::array<std::string, 6> RepeatedOf(const HistoryRecord& record) {
  const Author& author = record.author;
  return {record.written,
          record.dataset,
          record.command,
          author.user,
          author.host,
          author.operator_name};
}

std::vector<StoredRecord> ReadHistory(const std::string& path) {
  if (!IsThere(path) && fs::exists(path))
    throw InputError(FileLocation(path), "an empty file", "a history of hexcal");
  Database database(path, Kind(), Database::Access::kRead);
  RequireOwnTables(&database);
  Statement check(&database, "PRAGMA integrity_check(1)");
  if (!check.Step() || check.Text(0) != "ok")
    throw InputError(FileLocation(path), "damaged: " + check.Text(0));
  Statement statement(&database, std::string(kSelect) + "ORDER BY number");
  return RowsOf(&statement);
}

void RequireAppendable(const std::string& path) {
  if (IsThere(path)) {
    Database database(path, Kind(), Database::Access::kRead);
    RequireOwnTables(&database);
    LastOf(&database);
  }
  // The journal needs the folder, or the nearest one above it in which it is to be made.
  std::error_code ignored;
  const bool is_file = fs::exists(path, ignored);
  const std::string folder = NearestFolder(path);
  if (!fs::is_directory(folder, ignored))
    throw OutputError(fmt::format("{}: {} is no folder", path, folder));
  if (is_file && fs::is_directory(path, ignored))
    throw OutputError(fmt::format("{}: a folder is in the way", path));
  for (const std::string& place : {folder, is_file ? path : folder})
    if (access(place.c_str(), W_OK) != 0)
      throw OutputError(
          fmt::format("{}: cannot append to this history: {}", path, std::strerror(errno)));
}

struct PendingRecord::File {
  explicit File(const std::string& path)
      : database(InFolder(path), Kind(), Database::Access::kWrite),
        transaction(Durable(&database)) {}
  static const std::string& InFolder(const std::string& path) {
    MakeFolder(FolderOf(path).string());
    return path;
  }
  // A commit stays even if the power fails right after it: the folder, too, is synchronised.
  static Database* Durable(Database* database) {
    database->Run("PRAGMA synchronous=EXTRA");
    return database;
  }
  Database database;
  Transaction transaction;
};

PendingRecord::PendingRecord(const std::string& path, HistoryRecord record)
    : file_(std::make_unique<File>(path)), record_(std::move(record)) {
  RequireOwnTables(&file_->database);
  const std::optional<StoredRecord> last = LastOf(&file_->database);
  record_.number = last ? last->number + 1 : 1;
  record_.previous = last ? last->hash : std::string(kNoHash);
  text_ = CanonicalText(record_);
  hash_ = Sha256(text_);
  record_ = *ParseRecord(text_);  // with what is not UTF-8 replaced, as the columns must have it
}

PendingRecord::~PendingRecord() = default;

std::vector<StoredRecord> PendingRecord::Before(std::size_t at_most) const {
  Statement statement(&file_->database,
                      std::string(kSelect) + "WHERE dataset = ? ORDER BY number DESC LIMIT ?");
  statement.Bind(1, record_.dataset).Bind(2, static_cast<std::int64_t>(at_most));
  std::vector<StoredRecord> rows = RowsOf(&statement);
  std::reverse(rows.begin(), rows.end());
  return rows;
}

void PendingRecord::Commit() {
  Statement statement(&file_->database, "INSERT INTO record VALUES (?,?,?,?,?,?,?,?,?,?)");
  statement.Bind(1, std::int64_t{record_.number})
      .Bind(2, record_.previous)
      .Bind(3, hash_)
      .Bind(4, text_);
  int place = 5;
  for (const std::string& text : RepeatedOf(record_)) statement.Bind(place++, text);
  statement.Step();
  file_->transaction.Commit();
}

}  // namespace hexcal
