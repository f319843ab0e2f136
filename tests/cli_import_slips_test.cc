// SPDX-License-Identifier: BSD-3-Clause
// hexcal import from outside: what users do wrong with files that are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::string kTracker = HEXCAL_EXAMPLES "/ndi-and-pi/tracker.csv";
const std::string kRobot = "--robot=" HEXCAL_EXAMPLES "/ndi-and-pi/hexapod.dat";

class CliImportSlips : public ::testing::Test {
 protected:
  ProgramResult Import(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {
        "import", "ndi_csv", kTracker, kRobot, "--pair=rows", "--out=mine"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunHexcal({arguments, folder.Path("")});
  }
  ProgramResult ImportRightly(std::vector<std::string> more) const {
    more.insert(more.end(), {"--base=0x0A", "--tool=0x0B"});
    return Import(more);
  }

  TemporaryFolder folder;
};

// A second run replaces the first, but no key that was added by hand since.
TEST_F(CliImportSlips, KeepsADatasetThatWasWorkedOn) {
  ASSERT_EQ(ImportRightly({}).status, 0);
  ASSERT_EQ(ImportRightly({"--kind=poses"}).status, 0);
  const std::string text = folder.Read("mine/dataset.yaml") + "gravity: [0, 0, -1]\n";
  folder.Write("mine/dataset.yaml", text);
  const ProgramResult refused = ImportRightly({});
  EXPECT_EQ(refused.status, 5);
  EXPECT_THAT(refused.err, HasSubstr("mine/dataset.yaml: this file or a table of it was changed"));
  EXPECT_EQ(folder.Read("mine/dataset.yaml"), text);
  EXPECT_EQ(ImportRightly({"--force"}).status, 0);
}

}  // namespace
}  // namespace hexcal
