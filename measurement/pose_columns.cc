// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/pose_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "geometry/rotation_angles.h"
#include "measurement/checked_values.h"
#include "measurement/labels.h"
#include "measurement/table_input.h"

namespace hexcal {
namespace {

using Names = std::vector<std::string_view>;

// Without x y z, which the first three share.
const std::array<Names, 4>& OwnColumns() {
  static const std::array<Names, 4> columns = {
      Names{"rx", "ry", "rz"},
      Names{"qw", "qx", "qy", "qz"},
      Names{"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"},
      Names{"l1", "l2", "l3", "l4", "l5", "l6"}};
  return columns;
}

const Names& Translation() {
  static const Names columns = {"x", "y", "z"};
  return columns;
}

Names ColumnsOf(PoseColumns::Set set) {
  Names columns;
  if (set != PoseColumns::Set::kLegs) columns = Translation();
  const Names& own = OwnColumns()[static_cast<int>(set)];
  columns.insert(columns.end(), own.begin(), own.end());
  return columns;
}

constexpr const char* kPoseSets = "x y z with rx ry rz, qw qx qy qz or r11 r12 ... r33";

std::string SetsInWords(bool legs_allowed) {
  return fmt::format("{}{}", kPoseSets, legs_allowed ? " (or l1 l2 ... l6 in their place)" : "");
}

int FirstPresent(const TableReader& table, const Names& names) {
  int first = -1;
  for (const std::string_view name : names) {
    const int column = table.Column(name);
    if (column >= 0 && (first < 0 || column < first)) first = column;
  }
  return first;
}

// The set whose own columns are there; x y z beside leg lengths are refused as another set's.
PoseColumns::Set FindSet(const TableReader& table, bool legs_allowed) {
  std::vector<std::pair<int, int>> found;  // first column of a set, set
  for (int set = 0; set < (legs_allowed ? 4 : 3); ++set) {
    const int first = FirstPresent(table, OwnColumns()[set]);
    if (first >= 0) found.emplace_back(first, set);
  }
  const int first_translation = FirstPresent(table, Translation());
  if (found.empty())
    throw InputError(table.HeaderLocation(std::max(first_translation, 0)),
                     first_translation >= 0 ? "a position without columns for the rotation"
                                            : "no columns for a pose",
                     SetsInWords(legs_allowed));
  if (found.size() == 1 && found[0].second == 3 && first_translation >= 0)
    found.emplace_back(first_translation, 0);
  if (found.size() == 1) return static_cast<PoseColumns::Set>(found[0].second);
  std::sort(found.begin(), found.end());
  throw InputError(table.HeaderLocation(found[1].first),
                   fmt::format("columns of two sets, {} and {}",
                               table.header()[found[0].first],
                               table.header()[found[1].first]),
                   SetsInWords(legs_allowed));
}

std::vector<int> FindColumns(const TableReader& table, PoseColumns::Set set) {
  const Names names = ColumnsOf(set);
  std::vector<int> columns;
  for (const std::string_view name : names) {
    columns.push_back(table.Column(name));
    if (columns.back() < 0)
      throw InputError(table.HeaderLocation(0),
                       fmt::format("no column '{}'", name),
                       fmt::format("the whole set pose {}", fmt::join(names, " ")));
  }
  return columns;
}

}  // namespace

bool PoseColumns::IsReserved(std::string_view column) {
  const auto has = [&](const Names& names) {
    return std::find(names.begin(), names.end(), column) != names.end();
  };
  return column == "pose" || has(Translation()) ||
         std::any_of(OwnColumns().begin(), OwnColumns().end(), has);
}

PoseColumns::PoseColumns(const TableReader& table,
                         bool legs_allowed,
                         const std::vector<std::string_view>& others) {
  Names optional = Translation();
  for (int set = 0; set < (legs_allowed ? 4 : 3); ++set)
    optional.insert(optional.end(), OwnColumns()[set].begin(), OwnColumns()[set].end());
  optional.insert(optional.end(), others.begin(), others.end());
  CheckColumns(table,
               {"pose"},
               optional,
               fmt::format("pose, {}{}",
                           SetsInWords(legs_allowed),
                           legs_allowed ? ", and what covariates: declares" : ""));
  set_ = FindSet(table, legs_allowed);
  columns_ = FindColumns(table, set_);
}

Pose3d PoseColumns::ReadPose(const TableReader& table, const Units& units) const {
  // Braces keep the order of calls, so that the first bad cell is the one that is named.
  const auto number = [&](int i) { return table.Number(columns_[i]); };
  const auto length = [&](int i) { return ReadLength(table, columns_[i], units); };
  const Eigen::Vector3d xyz{length(0), length(1), length(2)};
  const Location where = table.CellLocation(columns_[3]);
  if (set_ == Set::kQuaternion)
    return {xyz, CheckedQuaternion({number(3), number(4), number(5), number(6)}, where)};
  if (set_ == Set::kMatrix) {
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = number(3 + i);
    return MakePose(CheckedRotation(matrix, where), xyz);
  }
  // Read first: an exception within << would leave it unfinished, which Eigen's own checks take for
  // a mistake of the program.
  const Eigen::Vector3d angles = units.angle * Eigen::Vector3d{number(3), number(4), number(5)};
  Vector6d pose_vector;
  pose_vector << xyz, angles;
  return PoseFromVector(pose_vector);
}

std::array<double, kNumLegs> PoseColumns::ReadLegs(const TableReader& table,
                                                   const Units& units) const {
  std::array<double, kNumLegs> lengths;
  for (int leg = 0; leg < kNumLegs; ++leg) {
    lengths[leg] = ReadLength(table, columns_[leg], units);
    if (!(lengths[leg] > 0))
      throw InputError(
          table.CellLocation(columns_[leg]),
          fmt::format("{} for the length of leg {}", Quoted(table.Text(columns_[leg])), leg + 1),
          "a length above zero");
  }
  return lengths;
}

bool PoseColumns::HasLargeAngle(const TableReader& table, const Units& units) const {
  if (set_ != Set::kAngles) return false;
  for (int i = 3; i < 6; ++i)
    if (std::abs(units.angle * table.Number(columns_[i])) > 2 * kPi) return true;
  return false;
}

}  // namespace hexcal
