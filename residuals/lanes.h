// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace hexcal {

// Several poses side by side, one a lane, so that plain arithmetic works on all of them at once (a
// vector type of GCC and Clang). Only for the passes over a PoseBatch: everything here must end up
// inlined in one function, which the compiler then makes for several kinds of processor. What holds
// them in memory must be aligned to their size by alignas: the baseline's own alignment is less.
constexpr int kLanes = 4;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

#define HEXCAL_INLINE inline __attribute__((always_inline))

// T is double or Lanes.
template <typename T>
struct Vec {
  T x, y, z;
};

template <typename T>
struct Quat {
  T x, y, z, w;
};

template <typename T>
struct Mat {
  T m[3][3];
};

template <typename T>
HEXCAL_INLINE Vec<T> operator+(const Vec<T>& a, const Vec<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <typename T>
HEXCAL_INLINE Vec<T> operator-(const Vec<T>& a, const Vec<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <typename T>
HEXCAL_INLINE Vec<T> Scaled(const T& s, const Vec<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <typename T>
HEXCAL_INLINE T Dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <typename T>
HEXCAL_INLINE Vec<T> Cross(const Vec<T>& a, const Vec<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename T>
HEXCAL_INLINE Quat<T> operator*(const Quat<T>& a, const Quat<T>& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
          a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

template <typename T>
HEXCAL_INLINE Quat<T> Conjugate(const Quat<T>& q) {
  return {-q.x, -q.y, -q.z, q.w};
}

template <typename T>
HEXCAL_INLINE Mat<T> RotationOf(const Quat<T>& q) {
  const T x2 = q.x + q.x, y2 = q.y + q.y, z2 = q.z + q.z;
  const T xx = q.x * x2, yy = q.y * y2, zz = q.z * z2;
  const T xy = q.x * y2, xz = q.x * z2, yz = q.y * z2;
  const T wx = q.w * x2, wy = q.w * y2, wz = q.w * z2;
  return {{{1.0 - yy - zz, xy - wz, xz + wy},
           {xy + wz, 1.0 - xx - zz, yz - wx},
           {xz - wy, yz + wx, 1.0 - xx - yy}}};
}

template <typename T>
HEXCAL_INLINE Vec<T> Rotated(const Quat<T>& q, const Vec<T>& p) {
  const Vec<T> v{q.x, q.y, q.z};
  const Vec<T> c = Cross(v, p);
  const Vec<T> twice = c + c;
  return p + Scaled(q.w, twice) + Cross(v, twice);
}

template <typename T>
HEXCAL_INLINE Vec<T> operator*(const Mat<T>& r, const Vec<T>& v) {
  return {r.m[0][0] * v.x + r.m[0][1] * v.y + r.m[0][2] * v.z,
          r.m[1][0] * v.x + r.m[1][1] * v.y + r.m[1][2] * v.z,
          r.m[2][0] * v.x + r.m[2][1] * v.y + r.m[2][2] * v.z};
}

// r' v
template <typename T>
HEXCAL_INLINE Vec<T> TransposeTimes(const Mat<T>& r, const Vec<T>& v) {
  return {r.m[0][0] * v.x + r.m[1][0] * v.y + r.m[2][0] * v.z,
          r.m[0][1] * v.x + r.m[1][1] * v.y + r.m[2][1] * v.z,
          r.m[0][2] * v.x + r.m[1][2] * v.y + r.m[2][2] * v.z};
}

template <typename T>
HEXCAL_INLINE Mat<T> operator*(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
  return c;
}

// a b'
template <typename T>
HEXCAL_INLINE Mat<T> TimesTranspose(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c.m[i][j] = a.m[i][0] * b.m[j][0] + a.m[i][1] * b.m[j][1] + a.m[i][2] * b.m[j][2];
  return c;
}

// a' b
template <typename T>
HEXCAL_INLINE Mat<T> TransposeTimes(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c.m[i][j] = a.m[0][i] * b.m[0][j] + a.m[1][i] * b.m[1][j] + a.m[2][i] * b.m[2][j];
  return c;
}

template <typename T>
HEXCAL_INLINE Mat<T> operator+(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[i][j] + b.m[i][j];
  return c;
}

template <typename T>
HEXCAL_INLINE Mat<T> operator-(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c.m[i][j] = a.m[i][j] - b.m[i][j];
  return c;
}

// m [v]x: every row crossed with v.
template <typename T>
HEXCAL_INLINE Mat<T> TimesSkew(const Mat<T>& m, const Vec<T>& v) {
  Mat<T> c;
  for (int i = 0; i < 3; ++i) {
    c.m[i][0] = m.m[i][1] * v.z - m.m[i][2] * v.y;
    c.m[i][1] = m.m[i][2] * v.x - m.m[i][0] * v.z;
    c.m[i][2] = m.m[i][0] * v.y - m.m[i][1] * v.x;
  }
  return c;
}

// [v]x m: v crossed with every column.
template <typename T>
HEXCAL_INLINE Mat<T> SkewTimes(const Vec<T>& v, const Mat<T>& m) {
  Mat<T> c;
  for (int j = 0; j < 3; ++j) {
    c.m[0][j] = v.y * m.m[2][j] - v.z * m.m[1][j];
    c.m[1][j] = v.z * m.m[0][j] - v.x * m.m[2][j];
    c.m[2][j] = v.x * m.m[1][j] - v.y * m.m[0][j];
  }
  return c;
}

template <typename T>
HEXCAL_INLINE Mat<T> SkewOf(const Vec<T>& v) {
  const T zero = {};
  return {{{zero, -v.z, v.y}, {v.z, zero, -v.x}, {-v.y, v.x, zero}}};
}

}  // namespace hexcal
