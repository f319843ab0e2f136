// SPDX-License-Identifier: BSD-3-Clause
// Every folder of tests/bad_datasets/ through the program: status 3, the expected message and
// nothing else, no file left behind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> Folders() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(HEXCAL_BAD_DATASETS))
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

class CliBadDataset : public ::testing::TestWithParam<std::string> {};

TEST_P(CliBadDataset, IsRefusedAndLeavesNoFile) {
  const std::string folder = (fs::path(HEXCAL_BAD_DATASETS) / GetParam()).string();
  std::string expected;
  std::ifstream file(folder + "/expected.txt");
  std::getline(file, expected);
  ASSERT_FALSE(expected.empty());

  const testing::TemporaryFolder here;
  const testing::ProgramResult result =
      testing::RunHexcal({{"calibrate", folder + "/dataset.yaml", "--out=out"}, here.Path("")});
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.err, "hexcal: " + folder + "/" + expected + "\n");
  EXPECT_THAT(result.out, ::testing::IsEmpty());
  EXPECT_THAT(here.Names(), ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Catalogue,
                         CliBadDataset,
                         ::testing::ValuesIn(Folders()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace hexcal
