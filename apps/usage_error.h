// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace hexcal {

// A command line that asks for something that is not there: exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hexcal
