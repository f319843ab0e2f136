// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "config/table.h"
#include "config/units.h"
#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// The columns in which a table states its poses: x y z with angles (Eq. 2), a quaternion or a
// rotation matrix; or six leg lengths.
class PoseColumns {
 public:
  enum class Set { kAngles, kQuaternion, kMatrix, kLegs };

  // Finds the one set whose columns the header has. InputError for columns of two sets, for a set
  // that is not whole, and for a column that is neither of a set nor "pose" nor in others.
  PoseColumns(const TableReader& table,
              bool legs_allowed,
              const std::vector<std::string_view>& others);

  Set set() const { return set_; }
  // The pose in the table's row, or the leg lengths, in m.
  Pose3d ReadPose(const TableReader& table, const Units& units) const;
  std::array<double, kNumLegs> ReadLegs(const TableReader& table, const Units& units) const;
  // Whether the row holds an angle of more than a turn either way, rad; only with angles.
  bool HasLargeAngle(const TableReader& table, const Units& units) const;

  // All names that a set may use: no covariate may be called so.
  static bool IsReserved(std::string_view column);

 private:
  Set set_;
  std::vector<int> columns_;  // of the set, in the set's order
};

}  // namespace hexcal
