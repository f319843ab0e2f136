// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "estimator/conventions.h"
#include "measurement/dataset.h"
#include "measurement/importers/assemble.h"

namespace hexcal {

// For which of the files a column map says what their columns mean.
struct ByMap {
  bool robot = false, tracker = false;
};

// Tries other conventions on the imported data and prints a warning where another than the stated
// one fits ten times better. Gives what was found where none does; nothing where one does, or where
// there is too little to tell.
std::optional<Conventions> CheckConventions(const Recording& robot,
                                            const std::vector<Recording>& tracker,
                                            const AssembleOptions& options,
                                            const ByMap& by_map,
                                            const Dataset& dataset);

}  // namespace hexcal
