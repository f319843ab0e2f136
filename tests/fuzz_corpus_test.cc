// SPDX-License-Identifier: BSD-3-Clause
// What the fuzzers found worth keeping (scripts/fuzz), read again by the build at hand; under
// scripts/sanitize with memory checked.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fuzz/readers.h"
#include "testing/temporary_folder.h"

namespace hexcal {

namespace fuzz {
void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }
}  // namespace fuzz

namespace {

std::vector<fuzz::Reader> AllReaders() {
  std::vector<fuzz::Reader> readers = fuzz::DataReaders();
  for (const auto& more : {fuzz::ReportReaders(), fuzz::ProgramReaders()})
    readers.insert(readers.end(), more.begin(), more.end());
  return readers;
}

class FuzzCorpus : public ::testing::TestWithParam<fuzz::Reader> {};

TEST_P(FuzzCorpus, IsTakenOrRefused) {
  const testing::TemporaryFolder folder;
  fuzz::WriteCompanions(folder.Path("in"));
  const std::filesystem::path corpus = std::filesystem::path(HEXCAL_FUZZ_CORPUS) / GetParam().name;
  int taken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    SCOPED_TRACE(entry.path().filename().string());
    EXPECT_NO_THROW(taken += fuzz::Meet(GetParam(), folder.Path("in"), bytes.str()));
  }
  EXPECT_GT(taken, 0);  // what is all refused leads no fuzzer far
}

INSTANTIATE_TEST_SUITE_P(All,
                         FuzzCorpus,
                         ::testing::ValuesIn(AllReaders()),
                         [](const auto& reader) { return reader.param.name; });

// The oracle itself: what is no InputError gets out.
TEST(FuzzMeet, LetsOtherExceptionsOut) {
  const testing::TemporaryFolder folder;
  const fuzz::Reader bad = {
      "bad", "in", [](const std::string&, const std::string&, const fuzz::Reader&) {
        throw std::out_of_range("bad");
      }};
  EXPECT_THROW(fuzz::Meet(bad, folder.Path(""), "x"), std::out_of_range);
}

}  // namespace
}  // namespace hexcal
