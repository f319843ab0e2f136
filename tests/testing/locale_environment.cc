// SPDX-License-Identifier: BSD-3-Clause
// In every test program: with HEXCAL_TEST_LOCALE=de_DE.UTF-8 its tests run in that locale, of C and
// of C++ (scripts/test_locale).
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <string>

namespace hexcal::testing {
namespace {

std::string ByStream(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string ByPrintf(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

class LocaleEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    const char* name = std::getenv("HEXCAL_TEST_LOCALE");
    if (name == nullptr) return;
    ASSERT_NO_THROW(std::locale::global(std::locale(name))) << name << " is not installed";
    ASSERT_EQ(ByStream(1.25), "1,25") << name;
    ASSERT_EQ(ByPrintf(1.25), "1,25") << name;
  }
};

[[maybe_unused]] const auto* const kEnvironment =
    ::testing::AddGlobalTestEnvironment(new LocaleEnvironment);

}  // namespace
}  // namespace hexcal::testing
