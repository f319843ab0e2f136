// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstdint>
#include <cstring>

#include "geometry/pose.h"

namespace hexcal::testing {

inline std::uint64_t Bits(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

// Equal to the last bit: 0 and -0 differ, a NaN equals itself.
inline ::testing::AssertionResult SameBits(double actual, double expected) {
  if (Bits(actual) == Bits(expected)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << actual << " is not to the bit " << expected
                                       << " (they differ by " << actual - expected << ")";
}

template <typename A, typename B>
::testing::AssertionResult SameBits(const Eigen::MatrixBase<A>& actual,
                                    const Eigen::MatrixBase<B>& expected) {
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols())
    return ::testing::AssertionFailure() << "sizes differ";
  for (Eigen::Index i = 0; i < actual.rows(); ++i)
    for (Eigen::Index j = 0; j < actual.cols(); ++j)
      if (const auto same = SameBits(actual(i, j), expected(i, j)); !same)
        return ::testing::AssertionFailure() << "at (" << i << ", " << j << ") " << same.message();
  return ::testing::AssertionSuccess();
}

inline ::testing::AssertionResult SameBits(const Pose3d& actual, const Pose3d& expected) {
  if (const auto same = SameBits(actual.translation, expected.translation); !same) return same;
  return SameBits(actual.rotation.coeffs(), expected.rotation.coeffs());
}

}  // namespace hexcal::testing
