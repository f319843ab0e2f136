// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "residuals/lanes.h"

namespace hexcal {

// A rotation vector e and the c of LeftJacobianInverse(e) = 1 - [e]/2 + c [e]^2.
template <typename T>
struct Turn {
  Vec<T> vector;
  T curvature;
};

// Where the squared sine of half the angle is below this the series below are exact to rounding.
constexpr double kSeriesLimit = 0.05;

// Log of unit quaternions with small turns: asin(s)/s and (1 - (a/2) cot(a/2))/a^2 as power series,
// s = sin(a/2). Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.40 and 4.3.70.
template <typename T>
HEXCAL_INLINE Turn<T> LogOfSmall(const Quat<T>& q) {
  const Vec<T> v{q.x, q.y, q.z};
  const T x = Dot(v, v);
  // Coefficients (2k)! / (4^k k!^2 (2k+1)), k = 12 ... 0.
  constexpr double kAsin[] = {676039.0 / 104857600.0,
                              88179.0 / 12058624.0,
                              46189.0 / 5505024.0,
                              12155.0 / 1245184.0,
                              6435.0 / 557056.0,
                              143.0 / 10240.0,
                              231.0 / 13312.0,
                              63.0 / 2816.0,
                              35.0 / 1152.0,
                              5.0 / 112.0,
                              3.0 / 40.0,
                              1.0 / 6.0,
                              1.0};
  T series = x * kAsin[0] + kAsin[1];
  for (int k = 2; k < 13; ++k) series = series * x + kAsin[k];
  T twice = 2.0 * series;
  twice = q.w < 0.0 ? -twice : twice;
  const T squared = 4.0 * x * series * series;  // of the angle
  // |B_2k| / (2k)!, k = 8 ... 1.
  constexpr double kCot[] = {3617.0 / 10670622842880000.0,
                             1.0 / 74724249600.0,
                             691.0 / 1307674368000.0,
                             1.0 / 47900160.0,
                             1.0 / 1209600.0,
                             1.0 / 30240.0,
                             1.0 / 720.0,
                             1.0 / 12.0};
  T c = squared * kCot[0] + kCot[1];
  for (int k = 2; k < 8; ++k) c = c * squared + kCot[k];
  return {Scaled(twice, v), c};
}

// The same for any turn.
inline Turn<double> LogOfAny(const Quat<double>& q) {
  const Vec<double> v{q.x, q.y, q.z};
  const double squared = Dot(v, v);
  if (squared < kSeriesLimit) return LogOfSmall(q);
  const double sine = std::sqrt(squared);
  const double half = std::atan2(sine, std::abs(q.w));
  const double scale = (q.w < 0.0 ? -2.0 : 2.0) * half / sine;
  const double angle = 2.0 * half;
  return {Scaled(scale, v), (1.0 - half * std::abs(q.w) / sine) / (angle * angle)};
}

HEXCAL_INLINE Turn<Lanes> LogOf(const Quat<Lanes>& q) {
  const Lanes squared = q.x * q.x + q.y * q.y + q.z * q.z;
  bool small = true;
  for (int l = 0; l < kLanes; ++l) small = small && squared[l] < kSeriesLimit;
  if (__builtin_expect(small, 1)) return LogOfSmall(q);
  Turn<Lanes> turn = {};
  for (int l = 0; l < kLanes; ++l) {
    const Turn<double> one = LogOfAny({q.x[l], q.y[l], q.z[l], q.w[l]});
    turn.vector.x[l] = one.vector.x, turn.vector.y[l] = one.vector.y;
    turn.vector.z[l] = one.vector.z, turn.curvature[l] = one.curvature;
  }
  return turn;
}

}  // namespace hexcal
