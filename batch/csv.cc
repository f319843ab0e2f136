// SPDX-License-Identifier: BSD-3-Clause
#include "batch/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "config/utf8.h"

namespace hexcal {
namespace {

constexpr int kLongestText = 300;

struct AppendText {
  std::string* line;
  void operator()(std::monostate) const {}
  void operator()(const std::string& text) const { *line += text; }
  template <typename Number>
  void operator()(Number number) const {
    fmt::format_to(std::back_inserter(*line), "{}", number);
  }
};

Cell Stored(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) {
    const std::string plain = PlainText(*text);
    return plain.empty() ? Cell() : Cell(plain);
  }
  const auto* number = std::get_if<double>(&cell);
  if (number == nullptr) return cell;
  return std::isnan(*number) ? Cell() : Cell(*number + 0.0);  // SQLite knows no -0
}

bool IsUtf8(const std::string& text) {
  try {
    RefuseBadText(text, {});
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

std::vector<Column> AllColumns(const Job& job) {
  std::vector<Column> all = {{"status", CellKind::kText}, {"message", CellKind::kText}};
  all.insert(all.end(), job.columns().begin(), job.columns().end());
  return all;
}

std::string PlainText(std::string_view text) {
  std::string plain = WithoutControls(text, ' ');
  std::replace(plain.begin(), plain.end(), ',', ';');
  std::replace(plain.begin(), plain.end(), '"', '\'');
  if (!IsUtf8(plain))
    for (char& c : plain)
      if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  plain = Shorten(plain, kLongestText);
  plain.erase(0, plain.find_first_not_of(' '));
  plain.erase(plain.find_last_not_of(' ') + 1);
  const bool is_formula =
      !plain.empty() && std::string_view("=+-@#").find(plain[0]) != std::string_view::npos;
  return is_formula ? "'" + plain : plain;
}

Row MakeRow(std::int64_t index, const Outcome& outcome, const std::vector<Column>& all_columns) {
  Row row;
  row.index = index;
  row.cells = {std::string(NameOf(outcome.status)), Stored(outcome.message)};
  for (const Cell& cell : outcome.cells) row.cells.push_back(Stored(cell));
  row.cells.resize(all_columns.size());
  return row;
}

std::string CsvHeader(const std::vector<Column>& all_columns) {
  std::string line = "study,idx";
  for (const Column& column : all_columns) line += "," + column.name;
  return line + "\n";
}

void AppendCsvLine(const std::string& study, const Row& row, std::string* text) {
  *text += study;
  *text += ',';
  AppendText{text}(row.index);
  for (const Cell& cell : row.cells) {
    *text += ',';
    std::visit(AppendText{text}, cell);
  }
  *text += '\n';
}

std::string CsvLine(const std::string& study, const Row& row) {
  std::string line;
  AppendCsvLine(study, row, &line);
  return line;
}

}  // namespace hexcal
