// SPDX-License-Identifier: BSD-3-Clause
#include "batch/store.h"

#include <fmt/format.h>

#include "config/input_error.h"

namespace hexcal {
namespace {

constexpr int kVersion = 1;

std::string_view SqlTypeOf(CellKind kind) {
  return kind == CellKind::kInteger ? "INTEGER" : kind == CellKind::kReal ? "REAL" : "TEXT";
}

std::string SchemaOf(const std::vector<Column>& columns) {
  std::string schema =
      "CREATE TABLE batch (study TEXT PRIMARY KEY, digest TEXT NOT NULL, rows INTEGER NOT NULL);"
      "CREATE TABLE results (study TEXT NOT NULL, idx INTEGER NOT NULL";
  for (const Column& column : columns)
    schema += fmt::format(", {} {}", column.name, SqlTypeOf(column.kind));
  return schema + ", UNIQUE (study, idx));";
}

std::string NamesOf(const std::vector<Column>& columns) {
  std::string names = "idx";
  for (const Column& column : columns) names += ", " + column.name;
  return names;
}

struct Binder {
  Statement* statement;
  int place;
  void operator()(std::monostate) const { statement->BindNull(place); }
  void operator()(std::int64_t value) const { statement->Bind(place, value); }
  void operator()(double value) const { statement->Bind(place, value); }
  void operator()(const std::string& value) const { statement->Bind(place, value); }
};

}  // namespace

Store::Store(const std::string& path, const Batch& batch, Database::Access access)
    : study_(batch.name),
      digest_(batch.digest),
      rows_per_task_(batch.job->outcomes_per_task()),
      columns_(AllColumns(*batch.job)) {
  const std::string schema = SchemaOf(columns_);
  const DatabaseKind kind = {kStoreMark, kVersion, "the results of hexcal batch", schema};
  database_ = std::make_unique<Database>(path, kind, access);
  if (access == Database::Access::kWrite) Describe(batch);
  RequireSameBatch();
  std::string places = "?, ?";
  for (std::size_t i = 0; i < columns_.size(); ++i) places += ", ?";
  insert_ = std::make_unique<Statement>(
      database_.get(),
      fmt::format(
          "INSERT OR IGNORE INTO results (study, {}) VALUES ({})", NamesOf(columns_), places));
  select_ = std::make_unique<Statement>(
      database_.get(),
      fmt::format("SELECT {} FROM results WHERE study = ? AND idx BETWEEN ? AND ? ORDER BY idx",
                  NamesOf(columns_)));
}

Store::~Store() = default;

// In a new file.
void Store::Describe(const Batch& batch) {
  Transaction transaction(database_.get());
  Statement insert(database_.get(),
                   "INSERT INTO batch SELECT ?, ?, ? WHERE NOT EXISTS (SELECT * FROM batch)");
  insert.Bind(1, study_).Bind(2, digest_).Bind(3, batch.rows()).Step();
  transaction.Commit();
}

void Store::RequireSameBatch() {
  Statement found(database_.get(), "SELECT study, digest FROM batch");
  const std::string study = found.Step() ? found.Text(0) : "";
  if (study == study_ && found.Text(1) == digest_) return;
  throw InputError(
      FileLocation(database_->path()),
      study == study_ ? fmt::format("results of another version of '{}'", study)
                      : fmt::format("results of '{}'", study),
      fmt::format("those of '{}': the manifest, a file that it names, or hexcal has changed "
                  "(--force begins anew, another --out keeps both)",
                  study_));
}

std::vector<std::int64_t> Store::Missing(const Chunks::Range& tasks) {
  Statement found(database_.get(),
                  "SELECT idx FROM results WHERE study = ? AND idx BETWEEN ? AND ? ORDER BY idx");
  found.Bind(1, study_)
      .Bind(2, tasks.first * rows_per_task_)
      .Bind(3, tasks.end * rows_per_task_ - 1);
  std::vector<std::int64_t> missing;
  std::int64_t next = tasks.first;  // the first that may be missing
  while (found.Step()) {
    const std::int64_t task = found.Integer(0) / rows_per_task_;
    for (; next < task; ++next) missing.push_back(next);
    next = task + 1;
  }
  for (; next < tasks.end; ++next) missing.push_back(next);
  return missing;
}

void Store::Insert(const std::vector<Row>& rows) {
  Transaction transaction(database_.get());
  for (const Row& row : rows) {
    insert_->Reset();
    insert_->Bind(1, study_).Bind(2, row.index);
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      std::visit(Binder{insert_.get(), static_cast<int>(i) + 3}, row.cells[i]);
    insert_->Step();
  }
  insert_->Reset();
  transaction.Commit();
}

Row Store::Read(const Statement& statement) const {
  Row row;
  row.index = statement.Integer(0);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const int at = static_cast<int>(i) + 1;
    if (statement.IsNull(at))
      row.cells.emplace_back();
    else if (columns_[i].kind == CellKind::kInteger)
      row.cells.emplace_back(statement.Integer(at));
    else if (columns_[i].kind == CellKind::kReal)
      row.cells.emplace_back(statement.Real(at));
    else
      row.cells.emplace_back(statement.Text(at));
  }
  return row;
}

bool Store::Find(std::int64_t index, Row* row) {
  select_->Reset();
  select_->Bind(1, study_).Bind(2, index).Bind(3, index);
  const bool found = select_->Step();
  if (found) *row = Read(*select_);
  select_->Reset();
  return found;
}

void Store::ForEach(std::int64_t first,
                    std::int64_t end,
                    const std::function<void(const Row&)>& use) {
  select_->Reset();
  select_->Bind(1, study_).Bind(2, first).Bind(3, end - 1);
  while (select_->Step()) use(Read(*select_));
  select_->Reset();
}

std::int64_t Store::Count() {
  Statement count(database_.get(), "SELECT count(*) FROM results WHERE study = ?");
  count.Bind(1, study_).Step();
  return count.Integer(0);
}

std::int64_t Store::Count(RowStatus status) {
  Statement count(database_.get(), "SELECT count(*) FROM results WHERE study = ? AND status = ?");
  count.Bind(1, study_).Bind(2, NameOf(status)).Step();
  return count.Integer(0);
}

std::vector<std::string> Store::Messages(RowStatus status, int at_most) {
  Statement found(
      database_.get(),
      "SELECT message FROM results WHERE study = ? AND status = ? ORDER BY idx LIMIT ?");
  found.Bind(1, study_).Bind(2, NameOf(status)).Bind(3, at_most);
  std::vector<std::string> messages;
  while (found.Step()) messages.push_back(found.Text(0));
  return messages;
}

void Store::Remove(RowStatus status) {
  Transaction transaction(database_.get());
  Statement(database_.get(),
            "DELETE FROM results WHERE study = ?1 AND idx / ?2 IN "
            "(SELECT idx / ?2 FROM results WHERE study = ?1 AND status = ?3)")
      .Bind(1, study_)
      .Bind(2, rows_per_task_)
      .Bind(3, NameOf(status))
      .Step();
  transaction.Commit();
}

}  // namespace hexcal
