// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "geometry/pose.h"

namespace hexcal {

// Eq. (42): root mean square of the position and of the orientation parts of pose errors.
class RmsError {
 public:
  void Add(const Vector6d& error) {
    position_ += error.head<3>().squaredNorm();
    orientation_ += error.tail<3>().squaredNorm();
    ++count_;
  }
  double Position() const { return std::sqrt(position_ / count_); }        // m
  double Orientation() const { return std::sqrt(orientation_ / count_); }  // rad

 private:
  double position_ = 0.0, orientation_ = 0.0;
  int count_ = 0;
};

}  // namespace hexcal
