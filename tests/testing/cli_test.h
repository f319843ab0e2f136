// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal::testing {

using Arguments = std::vector<std::string>;

// The built hexcal from outside, in a folder of its own.
class CliTest : public ::testing::Test {
 protected:
  // more: behind what all calls of a test have in common.
  ProgramResult Call(Arguments arguments, const Arguments& more = {}) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunHexcal({arguments, folder.Path("")});
  }

  TemporaryFolder folder;
};

}  // namespace hexcal::testing
