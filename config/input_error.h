// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace hexcal {

// A place in an input file. Line and column count from 1; 0 means "the whole file" or "the whole
// line".
struct Location {
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  std::string ToString() const;  // file:line:column, without the parts that are 0
};

Location FileLocation(std::string file);

// What the user can mend in an input: caught once, in main, which prints it and exits with 3.
class InputError : public std::runtime_error {
 public:
  // "file:line:column: found FOUND, expected EXPECTED"
  InputError(const Location& where, std::string_view found, std::string_view expected);
  InputError(const Location& where, std::string_view message);
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
};

// A file that could not be written: exit status 5.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hexcal
