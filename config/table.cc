// SPDX-License-Identifier: BSD-3-Clause
#include "config/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "config/line_reader.h"
#include "config/number.h"
#include "config/utf8.h"

namespace hexcal {
namespace {

constexpr long kMaxRows = 10'000'000;
constexpr std::int64_t kMaxFileBytes = std::int64_t{4} << 30;

std::string_view Trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::string CountCells(std::size_t count) {
  return count == 1 ? "1 cell" : fmt::format("{} cells", count);
}

}  // namespace

// What a row is made of, whatever it comes from.
struct TableReader::Impl {
  virtual ~Impl() = default;
  // Fills cells with the next row; false at the end.
  virtual bool Advance() = 0;
  virtual Location Table() const = 0;
  virtual Location Row() const = 0;
  virtual Location Cell(std::size_t column) const = 0;
  virtual bool Quoted(std::size_t /*column*/) const { return false; }
  // Why a row may have too many or too few cells.
  virtual std::string_view CountHint() const { return ""; }

  void ReadHeader();
  void CheckHeaderCell(std::size_t column,
                       std::unordered_map<std::string_view, std::size_t>& seen) const;

  std::vector<std::string> header;
  std::vector<Location> header_locations;
  std::vector<std::string_view> cells;
  long rows = 0;
};

void TableReader::Impl::CheckHeaderCell(
    std::size_t column, std::unordered_map<std::string_view, std::size_t>& seen) const {
  const std::string_view name = cells[column];
  const Location where = Cell(column);
  if (name.empty())
    throw InputError(where,
                     "an empty column name",
                     column + 1 == cells.size() ? "a name (is there a comma too many?)" : "a name");
  if (ParseDouble(name) && std::isfinite(*ParseDouble(name)))
    throw InputError(
        where, fmt::format("the number {} as column name", name), "a header row of column names");
  constexpr std::pair<char, std::string_view> kOthers[] = {
      {';', "';'"}, {'\t', "a tab"}, {' ', "a space"}};
  for (const auto& [separator, word] : kOthers)
    if (cells.size() == 1 && name.find(separator) != std::string_view::npos)
      throw InputError(where,
                       fmt::format("the single column '{}'", Shorten(name)),
                       fmt::format("',' between the columns, not {}", word));
  const auto [entry, is_new] = seen.emplace(name, column);
  if (!is_new)
    throw InputError(where,
                     fmt::format("the column '{}' a second time", Shorten(name)),
                     fmt::format("it once (the first is column {})", entry->second + 1));
}

void TableReader::Impl::ReadHeader() {
  constexpr std::string_view kHeader = "a header row with column names";
  if (!Advance()) throw InputError(Table(), "an empty table", kHeader);
  if (cells.empty()) throw InputError(Row(), "a row without cells", kHeader);
  std::unordered_map<std::string_view, std::size_t> seen;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    CheckHeaderCell(i, seen);
    header_locations.push_back(Cell(i));
  }
  header.assign(cells.begin(), cells.end());
}

namespace {

struct CsvTable : TableReader::Impl {
  explicit CsvTable(const std::string& path) : lines(path, kMaxFileBytes) {}

  bool Advance() override {
    do {
      if (!lines.Next()) return false;
    } while (Trim(lines.Line()).empty() || Trim(lines.Line()).front() == '#');
    const std::string_view line = lines.Line();
    const std::size_t quote = line.find('"');
    if (quote != std::string_view::npos)
      throw InputError(Place(quote), "a quote character", "cells without quotes or commas in them");
    cells.clear();
    std::size_t begin = 0;
    while (true) {
      const std::size_t comma = std::min(line.find(',', begin), line.size());
      cells.push_back(Trim(line.substr(begin, comma - begin)));
      if (comma == line.size()) return true;
      begin = comma + 1;
    }
  }

  Location Place(std::size_t offset) const {
    return lines.Where(1 + CountCharacters(lines.Line().substr(0, offset)));
  }
  Location Table() const override { return lines.File(); }
  Location Row() const override { return lines.Where(); }
  Location Cell(std::size_t column) const override {
    return Place(static_cast<std::size_t>(cells[column].data() - lines.Line().data()));
  }

  std::string_view CountHint() const override {
    const std::string_view line = lines.Line();
    if (line.find(';') != std::string_view::npos) return " (columns are separated by ',', not ';')";
    if (line.find('\t') != std::string_view::npos)
      return " (columns are separated by ',', not by tabs)";
    if (cells.size() == header.size() + 1 && cells.back().empty())
      return " (is there a comma at the end of the line?)";
    if (cells.size() > header.size()) return " (is a comma used as the decimal point?)";
    return "";
  }

  LineReader lines;
};

struct InlineTable : TableReader::Impl {
  explicit InlineTable(const YamlNode& all_rows) : table(all_rows) {
    ReadSequence(table, "a list of rows, the first the column names");
  }

  bool Advance() override {
    if (next == table.items.size()) return false;
    const YamlNode& row = table.items[next++];
    ReadSequence(row, "a row: a list of cells");
    cells.clear();
    for (const YamlNode& cell : row.items) {
      if (cell.kind != YamlNode::Kind::kScalar && cell.kind != YamlNode::Kind::kNull)
        throw InputError(cell.where, Describe(cell), "a number, a text or nothing as cell");
      cells.push_back(Trim(cell.scalar));
    }
    return true;
  }

  const YamlNode& CellNode(std::size_t column) const { return table.items[next - 1].items[column]; }
  Location Table() const override { return table.where; }
  Location Row() const override { return next == 0 ? table.where : table.items[next - 1].where; }
  Location Cell(std::size_t column) const override { return CellNode(column).where; }
  bool Quoted(std::size_t column) const override { return CellNode(column).quoted; }

  const YamlNode& table;
  std::size_t next = 0;
};

}  // namespace

TableReader::TableReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  impl_->ReadHeader();
}
TableReader::TableReader(TableReader&&) noexcept = default;
TableReader& TableReader::operator=(TableReader&&) noexcept = default;
TableReader::~TableReader() = default;

TableReader TableReader::FromFile(const std::string& path) {
  return TableReader(std::make_unique<CsvTable>(path));
}

TableReader TableReader::FromRows(const YamlNode& rows) {
  return TableReader(std::make_unique<InlineTable>(rows));
}

const std::vector<std::string>& TableReader::header() const { return impl_->header; }

int TableReader::Column(std::string_view name) const {
  const auto found = std::find(impl_->header.begin(), impl_->header.end(), name);
  return found == impl_->header.end() ? -1 : static_cast<int>(found - impl_->header.begin());
}

Location TableReader::HeaderLocation(int column) const {
  return impl_->header_locations.at(static_cast<std::size_t>(column));
}

Location TableReader::where() const { return impl_->Table(); }

bool TableReader::Next() {
  if (!impl_->Advance()) return false;
  if (impl_->cells.size() != impl_->header.size())
    throw InputError(
        impl_->Row(),
        CountCells(impl_->cells.size()),
        fmt::format("{} as in the header{}", impl_->header.size(), impl_->CountHint()));
  if (++impl_->rows > kMaxRows)
    throw InputError(impl_->Row(), "more than 10 million rows", "fewer");
  return true;
}

std::string_view TableReader::Text(int column) const {
  return impl_->cells[static_cast<std::size_t>(column)];
}

double TableReader::Number(int column) const {
  const std::string_view text = Text(column);
  const std::optional<double> value = ParseDouble(text);
  const bool quoted = impl_->Quoted(static_cast<std::size_t>(column));
  if (value && std::isfinite(*value) && !quoted) return *value;
  const std::string_view name = header()[static_cast<std::size_t>(column)];
  throw InputError(CellLocation(column),
                   text.empty() ? fmt::format("an empty cell in column '{}'", name)
                                : fmt::format("'{}' in column '{}'", Shorten(text), name),
                   "a number" + (value && quoted ? " (without quotes)" : NumberHint(text)));
}

Location TableReader::CellLocation(int column) const {
  return impl_->Cell(static_cast<std::size_t>(column));
}

Location TableReader::RowLocation() const { return impl_->Row(); }

}  // namespace hexcal
