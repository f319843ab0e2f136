// SPDX-License-Identifier: BSD-3-Clause
#include "config/input_error.h"

#include <gtest/gtest.h>

namespace hexcal {
namespace {

TEST(InputError, SaysWhereWhatAndWhatElse) {
  const Location where = {FileLocation("f.yaml").file, 3, 7};
  EXPECT_STREQ(InputError(where, "x", "y").what(), "f.yaml:3:7: found x, expected y");
  EXPECT_STREQ(InputError(where, "all is lost").what(), "f.yaml:3:7: all is lost");
  EXPECT_STREQ(InputError(FileLocation("g"), "x", "y").what(), "g: found x, expected y");
}

TEST(InputError, LetsNoControlCharacterThrough) {
  const Location where = FileLocation("a\tb");
  EXPECT_STREQ(InputError(where, "\x1b[31mred\n", "\x7fplain µ").what(),
               "a b: found  [31mred , expected  plain µ");
  // U+009B is ESC [ in one character, which some terminals obey; U+00B5 shares its first byte.
  EXPECT_STREQ(InputError(where, "\u009b31m\u0085 \u00a0µ").what(), "a b:  31m  \u00a0µ");
  EXPECT_STREQ(InputError(where, "two\r\nlines").what(), "a b: two  lines");
}

}  // namespace
}  // namespace hexcal
