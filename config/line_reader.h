// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "config/input_error.h"
#include "config/input_file.h"

namespace hexcal {

// The lines of a text file, one after another, without a copy of each. UTF-8 with or without a
// byte-order mark, LF or CRLF; anything else is refused, and so is a line above 1 MiB.
class LineReader {
 public:
  LineReader(const std::string& path, std::int64_t max_bytes);

  // Moves to the next line; false at the end.
  bool Next();
  // Without its line end; valid until Next().
  std::string_view Line() const { return line_; }
  // column counts from 1; 0 means the whole line.
  Location Where(int column = 0) const;
  Location File() const { return {name_, 0, 0}; }

 private:
  bool Fill();
  void TakeLine(std::size_t end);

  std::shared_ptr<const std::string> name_;
  InputFile file_;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what is not yet taken
  std::size_t end_ = 0;
  std::string_view line_;
  std::int64_t number_ = 0;
};

}  // namespace hexcal
