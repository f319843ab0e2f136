// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/delimited_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "config/number.h"
#include "config/utf8.h"
#include "measurement/importers/missing.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

// begin: behind the opening quote. Gives what stands behind the closing one.
std::size_t DelimitedReader::TakeQuoted(std::size_t begin, Cell& cell) const {
  const std::string_view line = Line();
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (line[i] != '"') {
      cell.text += line[i];
    } else if (i + 1 < line.size() && line[i + 1] == '"') {
      cell.text += line[i++];
    } else {
      return i + 1;
    }
  }
  throw InputError(lines_.Where(1 + CountCharacters(line.substr(0, cell.offset))),
                   "a quote that does not end in its line",
                   "a closing '\"'");
}

void DelimitedReader::Split(char delimiter) {
  const std::string_view line = Line();
  const std::string_view blanks = delimiter == '\t' ? " " : " \t";
  const std::string ends = delimiter == ' ' ? " \t" : std::string(1, delimiter);
  cells_.clear();
  std::size_t at = 0;
  while (true) {
    at = std::min(line.find_first_not_of(blanks, at), line.size());
    if (delimiter == ' ' && at == line.size()) return;
    Cell cell{"", at};
    std::size_t end = 0;
    if (at < line.size() && line[at] == '"') {
      const std::size_t behind = TakeQuoted(at + 1, cell);
      end = std::min(line.find_first_of(ends, behind), line.size());
      if (!Trimmed(line.substr(behind, end - behind)).empty())
        throw InputError(lines_.Where(1 + CountCharacters(line.substr(0, behind))),
                         "text behind a closing quote",
                         "the end of the cell");
    } else {
      end = std::min(line.find_first_of(ends, at), line.size());
      cell.text = Trimmed(line.substr(at, end - at));
    }
    cells_.push_back(std::move(cell));
    if (end == line.size()) return;
    at = end + 1;
  }
}

void DelimitedReader::DropEmptyEnd(std::size_t at_least) {
  while (cells_.size() > at_least && cells_.back().text.empty()) cells_.pop_back();
}

Location DelimitedReader::At(std::size_t i) const {
  const std::size_t offset = i < cells_.size() ? cells_[i].offset : Line().size();
  return lines_.Where(1 + CountCharacters(Line().substr(0, offset)));
}

double DelimitedReader::Number(std::size_t i) const {
  std::string text(Text(i));
  const std::size_t comma = decimal_comma_ ? text.find(',') : std::string::npos;
  if (comma != std::string::npos) text[comma] = '.';
  const std::optional<double> value = ParseDouble(text);
  if (value && std::isfinite(*value)) return *value;
  throw InputError(At(i),
                   Text(i).empty() ? "an empty cell" : Quoted(Text(i)),
                   "a finite number" + NumberHint(Text(i)));
}

std::optional<double> DelimitedReader::NumberIfAny(std::size_t i) const {
  if (IsMissing(Text(i))) return std::nullopt;
  const double value = Number(i);
  if (IsMissing(value)) return std::nullopt;
  return value;
}

std::optional<Eigen::Vector3d> DelimitedReader::Point(
    const std::array<std::size_t, 3>& columns,
    double scale,
    const std::optional<double>& missing_value) const {
  Eigen::Vector3d point;
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::optional<double> value = NumberIfAny(columns[k]);
    if (value) point[static_cast<Eigen::Index>(k)] = *value;
    found += value ? 1 : 0;
  }
  if (found == 0) return std::nullopt;
  if (found < 3)
    throw InputError(
        At(columns[0]), fmt::format("{} of 3 coordinates", found), "all three, or none");
  if (missing_value && (point.array() == *missing_value).all()) return std::nullopt;
  return scale * point;
}

std::int64_t DelimitedReader::Seconds(std::size_t i) const {
  if (const std::optional<std::int64_t> time = ParseSeconds(Text(i))) return *time;
  throw InputError(At(i), Quoted(Text(i)), "a time in seconds");
}

void DelimitedReader::RequireSize(std::size_t size, std::string_view expected) const {
  if (cells_.size() == size) return;
  throw InputError(cells_.size() < size ? Where() : At(size),
                   fmt::format("{} {}", cells_.size(), cells_.size() == 1 ? "cell" : "cells"),
                   fmt::format("{}, {}", size, expected));
}

}  // namespace hexcal
