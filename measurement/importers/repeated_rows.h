// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// A warning where rows of a file are the same reading, by the numbers of their frames or, where the
// file has none, by their times; empty where none are. labels_differ: no two rows may have the same
// label either.
std::string RepeatedRows(const Recording& recording, bool labels_differ);

}  // namespace hexcal
