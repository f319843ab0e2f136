// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "config/input_error.h"

namespace hexcal::testing {

// The message of the InputError that action throws, or why there is none.
template <typename Action>
std::string InputErrorText(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("(another exception: ") + error.what() + ")";
  }
  return "(no exception)";
}

}  // namespace hexcal::testing
