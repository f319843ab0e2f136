// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace hexcal::testing {

// While it lives, C++ streams print and read 1.234,5 for 1234.5, as in much of Europe. The locale
// is built here, so that none need be installed.
class DecimalComma {
 public:
  DecimalComma() : before_(std::locale::global(std::locale(std::locale(), new Punctuation))) {}
  ~DecimalComma() { std::locale::global(before_); }
  DecimalComma(const DecimalComma&) = delete;
  DecimalComma& operator=(const DecimalComma&) = delete;

  static std::string Print(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
  }

 private:
  struct Punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

}  // namespace hexcal::testing
