// SPDX-License-Identifier: BSD-3-Clause
// Every folder of tests/bad_datasets/ (see its README.md) is refused with exactly the message that
// it expects. Not covered: mistakes that only a model can see, such as leg lengths that no pose
// reaches.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "measurement/dataset.h"

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

std::string ExpectedMessage(const fs::path& folder) {
  std::ifstream file(folder / "expected.txt");
  std::string line;
  std::getline(file, line);
  return line;
}

class BadDataset : public ::testing::TestWithParam<std::string> {};

TEST_P(BadDataset, IsRefusedWithTheExpectedMessage) {
  const fs::path folder = fs::path(HEXCAL_BAD_DATASETS) / GetParam();
  const std::string prefix = folder.string() + "/";
  try {
    ReadDataset(prefix + "dataset.yaml", /*needs_measurement=*/true);
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    ASSERT_EQ(message.substr(0, prefix.size()), prefix);
    EXPECT_EQ(message.substr(prefix.size()), ExpectedMessage(folder));
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue,
                         BadDataset,
                         ::testing::ValuesIn(Folders()),
                         [](const auto& parameter) { return parameter.param; });

TEST(BadDatasets, TheCatalogueIsWhole) { EXPECT_GE(Folders().size(), 60u); }

}  // namespace
}  // namespace hexcal
