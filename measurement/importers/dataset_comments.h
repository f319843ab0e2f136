// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/assemble.h"

namespace hexcal {

// The text of dataset.yaml with comments above its keys: where each part is from, how it was
// understood, and what may be added by hand.
std::string WithComments(const std::string& dataset_yaml, const Assembled& assembled);

}  // namespace hexcal
