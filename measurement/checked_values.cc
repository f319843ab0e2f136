// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/checked_values.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "geometry/align_points.h"

namespace hexcal {
namespace {

constexpr double kRotationTolerance = 1e-3;
constexpr double kUnitToRounding = 8 * std::numeric_limits<double>::epsilon();
constexpr double kSmallestRelativeSpread = 1e-3;

bool IsUnitToRounding(double squared_norm) { return std::abs(squared_norm - 1) <= kUnitToRounding; }

}  // namespace

Eigen::Quaterniond CheckedQuaternion(const Eigen::Vector4d& wxyz, const Location& where) {
  const Eigen::Quaterniond q(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (IsUnitToRounding(q.squaredNorm())) return q;
  if (std::abs(q.norm() - 1) <= kRotationTolerance) return q.normalized();
  throw InputError(where,
                   fmt::format("the quaternion [{}, {}, {}, {}] of length {:.6g}",
                               wxyz[0],
                               wxyz[1],
                               wxyz[2],
                               wxyz[3],
                               wxyz.stableNorm()),
                   "a unit quaternion w, x, y, z (length 1 within 0.001)");
}

Eigen::Matrix3d CheckedRotation(const Eigen::Matrix3d& matrix, const Location& where) {
  constexpr const char* kExpected =
      "a rotation matrix by rows (orthonormal, determinant 1, within 0.001)";
  const double misfit =
      (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(misfit <= kRotationTolerance))
    throw InputError(where,
                     fmt::format("a matrix R whose R'R differs from identity by {:.6g}", misfit),
                     kExpected);
  const double determinant = matrix.determinant();
  if (!(std::abs(determinant - 1) <= kRotationTolerance))
    throw InputError(where,
                     determinant < 0 ? fmt::format("a reflection (determinant {:.6g})", determinant)
                                     : fmt::format("a matrix of determinant {:.6g}", determinant),
                     kExpected);
  return NearestRotation(matrix);
}

Eigen::Vector3d CheckedDirection(const Eigen::Vector3d& direction,
                                 const Location& where,
                                 std::string_view what) {
  if ((direction.array() == 0).all())
    throw InputError(
        where, fmt::format("[0, 0, 0] for {}", what), "a direction, of any length but zero");
  if (IsUnitToRounding(direction.squaredNorm())) return direction;
  return direction.stableNormalized();
}

bool AreCollinear(const Eigen::Matrix3Xd& points) {
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean().eval();
  // As one vector: Eigen 3.4's stableNorm of a matrix with fixed rows fails its own assertion.
  const double extent =
      Eigen::Map<const Eigen::VectorXd>(centred.data(), centred.size()).stableNorm();
  return !(PlanarSpread(points) > kSmallestRelativeSpread * extent);  // NaN: collinear
}

}  // namespace hexcal
