// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// What the program hands to its caller (docs/commands.md).
enum ExitStatus : int {
  kDone = 0,
  kInternalError = 1,
  kWrongUsage = 2,
  kInputRefused = 3,
  kNotTrusted = 4,  // no convergence, or a direction that the data cannot determine
  kCannotWrite = 5,
  kSomeFailed = 6,         // of several datasets
  kRequirementFailed = 7,  // under audit --gate
  kInterrupted = 130,
};

}  // namespace hexcal
