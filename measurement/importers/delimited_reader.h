// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/line_reader.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// The lines of another program's text file and the cells in them. Unlike the tables of a dataset
// (config/table.h) these have preambles, repeated column names, quotes and tabs.
class DelimitedReader {
 public:
  explicit DelimitedReader(const std::string& path) : lines_(path, kMostImportBytes) {}

  // The next line; false at the end.
  bool Next() { return lines_.Next(); }
  // Numbers are written 1,5.
  void set_decimal_comma(bool decimal_comma) { decimal_comma_ = decimal_comma; }
  std::string_view Line() const { return lines_.Line(); }
  int LineNumber() const { return lines_.Where().line; }
  Location Where() const { return lines_.Where(); }
  Location File() const { return lines_.File(); }

  // Cuts the line into cells, trimmed. ' ' cuts at runs of blanks and tabs. A cell in double quotes
  // may hold the delimiter; "" in it is one quote.
  void Split(char delimiter);
  // Leaves out empty cells at the end, as some programs leave a delimiter there.
  void DropEmptyEnd(std::size_t at_least);

  std::size_t size() const { return cells_.size(); }
  std::string_view Text(std::size_t i) const { return cells_[i].text; }
  Location At(std::size_t i) const;  // the line's end where there is no such cell

  // A finite number; InputError.
  double Number(std::size_t i) const;
  // The same, or nothing where the cell says that there is none (missing.h).
  std::optional<double> NumberIfAny(std::size_t i) const;
  // x y z from cell i on, times scale, or nothing where it was not seen; InputError where only a
  // part is there.
  std::optional<Eigen::Vector3d> Point(std::size_t i,
                                       double scale,
                                       const std::optional<double>& missing_value) const {
    return Point({i, i + 1, i + 2}, scale, missing_value);
  }
  std::optional<Eigen::Vector3d> Point(const std::array<std::size_t, 3>& columns,
                                       double scale,
                                       const std::optional<double>& missing_value) const;
  // ns; InputError.
  std::int64_t Seconds(std::size_t i) const;

  // InputError unless the line has exactly this many cells.
  void RequireSize(std::size_t size, std::string_view expected) const;

 private:
  struct Cell {
    std::string text;
    std::size_t offset;  // in the line
  };
  std::size_t TakeQuoted(std::size_t begin, Cell& cell) const;

  LineReader lines_;
  std::vector<Cell> cells_;
  bool decimal_comma_ = false;
};

// Without blanks at the ends; letters a-z.
std::string_view Trimmed(std::string_view text);
std::string LowerCase(std::string_view text);

}  // namespace hexcal
