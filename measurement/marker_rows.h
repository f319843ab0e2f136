// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// What a table of markers has beside its readings.
struct MarkerRows {
  std::array<std::vector<long>, 2> unseen;  // rows without coordinates, by body and marker
  long frames = 0;                          // each of one pose, of which it has a row
};

// Reads the dataset's table once more, for who wants to account for every row; of a dataset that
// came from no file, its readings are all there is. InputError where the file has gone.
MarkerRows CountMarkerRows(const Dataset& dataset);

}  // namespace hexcal
