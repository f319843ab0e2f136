// SPDX-License-Identifier: BSD-3-Clause
#include "config/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>

#include "config/input_error.h"

namespace hexcal {
namespace {

constexpr int kPatienceMs = 60'000;

// SQLite's application id is these four bytes, most significant first.
std::int64_t IdOf(const DatabaseKind& kind) {
  std::int64_t id = 0;
  for (const char c : kind.mark) id = 256 * id + static_cast<unsigned char>(c);
  return id;
}

bool IsDamage(int code) {
  const int primary = code & 0xff;
  return primary == SQLITE_NOTADB || primary == SQLITE_CORRUPT || primary == SQLITE_FORMAT ||
         primary == SQLITE_ERROR;  // a table that should be there is not
}

}  // namespace

Database::Database(const std::string& path, const DatabaseKind& kind, Access access) : path_(path) {
  // To read, too: what a killed writer left half done must be taken back first. Where the file may
  // not be written SQLite opens it for reading by itself.
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX |
                    (access == Access::kWrite ? SQLITE_OPEN_CREATE : 0);
  const int opened = sqlite3_open_v2(path.c_str(), &handle_, flags, nullptr);
  try {
    if (handle_ == nullptr) throw OutputError(path + ": out of memory");
    if (opened == SQLITE_CANTOPEN && access == Access::kRead)
      throw InputError(FileLocation(path), "no file that can be read", std::string(kind.what));
    Check(opened);
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, kPatienceMs);
    Prepare(kind, access);
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::Run(const std::string& sql) {
  Check(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr));
}

void Database::Check(int code) const {
  if (code == SQLITE_OK) return;
  const std::string why = sqlite3_errmsg(handle_);
  if (IsDamage(code)) throw InputError(FileLocation(path_), "damaged, or no SQLite: " + why);
  throw OutputError(fmt::format("{}: {}", path_, why));
}

std::int64_t Database::Number(const std::string& sql) {
  Statement statement(this, sql);
  return statement.Step() ? statement.Integer(0) : 0;
}

void Database::Prepare(const DatabaseKind& kind, Access access) {
  if (access == Access::kRead) {
    Run("PRAGMA cache_size=-256");  // kB, of 2000: who reads once through needs none
    return CheckKind(kind);
  }
  Run("PRAGMA synchronous=FULL");
  Transaction transaction(this);
  if (Number("SELECT count(*) FROM sqlite_master") == 0 && Number("PRAGMA application_id") == 0) {
    Run(fmt::format("PRAGMA application_id={}; PRAGMA user_version={}; {}",
                    IdOf(kind),
                    kind.version,
                    kind.schema));
    return transaction.Commit();
  }
  CheckKind(kind);
}

void Database::CheckKind(const DatabaseKind& kind) {
  if (Number("PRAGMA application_id") != IdOf(kind))
    throw InputError(FileLocation(path_), "another program's database", std::string(kind.what));
  const std::int64_t version = Number("PRAGMA user_version");
  if (version != kind.version)
    throw InputError(FileLocation(path_),
                     fmt::format("{} of version {}", kind.what, version),
                     fmt::format("version {}, which this hexcal knows", kind.version));
}

std::string DatabaseLibraryVersion() { return sqlite3_libversion(); }

Statement::Statement(Database* database, const std::string& sql) : database_(database) {
  database->Check(sqlite3_prepare_v2(
      database->handle_, sql.c_str(), static_cast<int>(sql.size()), &handle_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(handle_); }

Statement& Statement::Bind(int place, std::int64_t value) {
  database_->Check(sqlite3_bind_int64(handle_, place, value));
  return *this;
}

Statement& Statement::Bind(int place, double value) {
  if (std::isnan(value)) return BindNull(place);
  database_->Check(sqlite3_bind_double(handle_, place, value));
  return *this;
}

Statement& Statement::Bind(int place, std::string_view value) {
  database_->Check(sqlite3_bind_text64(
      handle_, place, value.data(), value.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::BindNull(int place) {
  database_->Check(sqlite3_bind_null(handle_, place));
  return *this;
}

bool Statement::Step() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_->Check(code);
  return false;
}

void Statement::Reset() {
  sqlite3_reset(handle_);
  sqlite3_clear_bindings(handle_);
}

bool Statement::IsNull(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_NULL;
}

std::int64_t Statement::Integer(int column) const { return sqlite3_column_int64(handle_, column); }

double Statement::Real(int column) const {
  return IsNull(column) ? std::numeric_limits<double>::quiet_NaN()
                        : sqlite3_column_double(handle_, column);
}

std::string Statement::Text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text == nullptr ? "" : std::string(text, sqlite3_column_bytes(handle_, column));
}

Transaction::Transaction(Database* database) : database_(database) {
  database->Run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_->Run("ROLLBACK");
  } catch (const std::exception&) {  // what made it fail is on its way up already
  }
}

void Transaction::Commit() {
  database_->Run("COMMIT");
  open_ = false;
}

}  // namespace hexcal
