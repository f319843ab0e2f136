// SPDX-License-Identifier: BSD-3-Clause
#include "batch/chunk_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "batch/csv.h"
#include "config/atomic_file.h"
#include "config/input_error.h"
#include "config/input_file.h"
#include "config/number.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;
constexpr std::string_view kEnd = ".csv";

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

[[noreturn]] void RefuseLine(const std::string& path, int line, std::string_view found) {
  Location where = FileLocation(path);
  where.line = line;
  throw InputError(where, found, "a chunk as hexcal batch wrote it (remove it to do it again)");
}

std::string CellText(const Row& row) { return CsvLine("", row); }

}  // namespace

ChunkFiles::ChunkFiles(const std::string& folder, const Batch& batch)
    : folder_(folder + "/chunks"), batch_(batch), columns_(AllColumns(*batch.job)) {}

std::string ChunkFiles::PathOf(std::int64_t chunk) const {
  return fmt::format("{}/{:06}{}", folder_, chunk, kEnd);
}

std::string ChunkFiles::HeadOf(std::int64_t chunk) const {
  return fmt::format("# hexcal/chunk/1 {} {} {}", batch_.name, batch_.digest, chunk);
}

bool ChunkFiles::AreThere() const {
  std::error_code ignored;
  return fs::exists(folder_, ignored);
}

std::vector<std::int64_t> ChunkFiles::Present() const {
  std::vector<std::int64_t> numbers;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
    const std::optional<long> number = ParseInteger(entry.path().stem().string());
    if (number && entry.path().extension() == kEnd && *number >= 0) numbers.push_back(*number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void ChunkFiles::Write(std::int64_t chunk, const std::vector<Row>& rows) const {
  std::string text = HeadOf(chunk) + "\n" + CsvHeader(columns_);
  for (const Row& row : rows) AppendCsvLine(batch_.name, row, &text);
  MakeFolder(folder_);
  WriteFileAtomically(PathOf(chunk), text + "# end\n");
}

std::vector<Row> ChunkFiles::Read(std::int64_t chunk) const {
  const std::string path = PathOf(chunk);
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return {};
  const std::vector<std::string> lines = Split(ReadTextFile(path, kMostBytes), '\n');
  if (lines[0] != HeadOf(chunk))
    RefuseLine(path, 1, "a chunk of another manifest, or of another version of hexcal");
  const std::size_t end = lines.size() - 2;
  if (lines.size() < 4 || lines[end] != "# end" || lines[1] + "\n" != CsvHeader(columns_))
    RefuseLine(path, 0, "not all of a chunk");
  std::vector<Row> rows;
  for (std::size_t i = 2; i < end; ++i)
    rows.push_back(ParseRow(path, static_cast<int>(i) + 1, lines[i]));
  return rows;
}

Row ChunkFiles::ParseRow(const std::string& path, int line_number, const std::string& line) const {
  const std::vector<std::string> cells = Split(line, ',');
  const std::optional<long> index = cells.size() > 1 ? ParseInteger(cells[1]) : std::nullopt;
  if (cells.size() != columns_.size() + 2 || !index || *index < 0 || *index >= batch_.rows())
    RefuseLine(path, line_number, "another row");
  Row row;
  row.index = *index;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string& text = cells[i + 2];
    if (text.empty()) {
      row.cells.emplace_back();
    } else if (columns_[i].kind == CellKind::kText) {
      row.cells.emplace_back(text);
    } else if (columns_[i].kind == CellKind::kInteger) {
      const std::optional<long> number = ParseInteger(text);
      if (!number) RefuseLine(path, line_number, fmt::format("'{}'", text));
      row.cells.emplace_back(std::int64_t{*number});
    } else {
      const std::optional<double> number = ParseDouble(text);
      if (!number) RefuseLine(path, line_number, fmt::format("'{}'", text));
      row.cells.emplace_back(*number);
    }
  }
  return row;
}

// First out of the way all at once: what a kill leaves of the rest is no chunk any more.
void ChunkFiles::RemoveAll() const {
  const std::string old = folder_ + ".old";
  std::error_code ignored;
  fs::remove_all(old, ignored);
  fs::rename(folder_, old, ignored);
  fs::remove_all(old, ignored);
}

std::vector<std::int64_t> ChunkFileSink::Missing(std::int64_t chunk) {
  const Chunks::Range range = chunks_[chunk];
  std::vector<std::int64_t> missing;
  if (store_ != nullptr)
    missing = store_->Missing(range);
  else
    for (std::int64_t task = range.first; task < range.end; ++task) missing.push_back(task);
  std::set<std::int64_t> done;
  for (const Row& row : files_->Read(chunk)) done.insert(row.index / rows_per_task_);
  const auto is_done = [&done](std::int64_t task) { return done.count(task) > 0; };
  missing.erase(std::remove_if(missing.begin(), missing.end(), is_done), missing.end());
  return missing;
}

void ChunkFileSink::Take(std::int64_t chunk, const std::vector<Row>& rows, bool) {
  std::vector<Row> all = files_->Read(chunk);  // of a run that was interrupted: the first ones
  all.insert(all.end(), rows.begin(), rows.end());
  files_->Write(chunk, all);
}

Merged MergeChunks(const ChunkFiles& files, Store* store) {
  Merged merged;
  for (const std::int64_t chunk : files.Present()) {
    std::vector<Row> fresh;
    for (Row& row : files.Read(chunk)) {
      Row there;
      if (!store->Find(row.index, &there)) {
        fresh.push_back(std::move(row));
        continue;
      }
      if (CellText(there) != CellText(row))
        throw InputError(FileLocation(files.PathOf(chunk)),
                         fmt::format("another result for row {} than the one stored", row.index),
                         "the same, whoever works on it (is this another processor?)");
      ++merged.duplicates;
    }
    merged.rows += static_cast<std::int64_t>(fresh.size());
    store->Insert(fresh);
  }
  return merged;
}

}  // namespace hexcal
