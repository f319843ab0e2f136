// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace hexcal {

// The rotation meant where numbers that were read as w x y z are z w x y (shift 1: read as x y z w,
// they stand as w x y z) or x y z w (shift 3: the other way round).
inline Eigen::Quaterniond Shifted(const Eigen::Quaterniond& read, int shift) {
  const double wxyz[] = {read.w(), read.x(), read.y(), read.z()};
  const auto at = [&](int i) { return wxyz[(i + shift) % 4]; };
  return {at(0), at(1), at(2), at(3)};
}

}  // namespace hexcal
