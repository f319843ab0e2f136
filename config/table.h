// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/input_error.h"
#include "config/strict_yaml.h"

namespace hexcal {

// Rows of a table, one after another, from a CSV file or from an inline YAML list of lists whose
// first row is the header. CSV: commas, '#' comment lines, blank lines skipped, UTF-8 with or
// without a byte-order mark, LF or CRLF; cells are trimmed; no quoting (a quote character is
// refused). At most 10 million rows; a file above 4 GiB is refused. Views of cells last until
// Next().
class TableReader {
 public:
  static TableReader FromFile(const std::string& path);
  // Keeps a reference to rows, which must live as long.
  static TableReader FromRows(const YamlNode& rows);
  static TableReader FromRows(YamlNode&& rows) = delete;
  TableReader(TableReader&&) noexcept;
  TableReader& operator=(TableReader&&) noexcept;
  ~TableReader();

  const std::vector<std::string>& header() const;
  // Index of a column, or -1.
  int Column(std::string_view name) const;
  // Location of a header cell.
  Location HeaderLocation(int column) const;
  Location where() const;  // the table itself

  // Moves to the next row; false at the end. A row with another number of cells than the header:
  // InputError.
  bool Next();
  std::string_view Text(int column) const;  // may be empty
  bool Empty(int column) const { return Text(column).empty(); }
  double Number(int column) const;  // finite, else InputError with line, column and cell
  Location CellLocation(int column) const;
  Location RowLocation() const;

  struct Impl;  // a CSV file or inline rows; defined in table.cc

 private:
  explicit TableReader(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hexcal
