// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "config/units.h"

namespace hexcal {

// A column by its name in the header or its number from 1.
struct ColumnName {
  std::string name;
  Location where;
};

struct MappedBody {
  enum class Rotation { kAngles, kQuaternion, kMatrix };
  std::string name;
  std::vector<ColumnName> position, rotation;
  Rotation kind = Rotation::kAngles;
  std::string order = "xyz";         // kAngles: geometry/rotation_order.h
  std::vector<std::string> markers;  // of ColumnMap::markers
};

struct MappedMarker {
  std::string name;
  std::vector<ColumnName> position;
};

// What the columns of a table mean, in a YAML file of the format hexcal/columns/1: docs/formats.md.
struct ColumnMap {
  char delimiter = ',';
  bool decimal_comma = false;
  long skip = 0;  // lines before the header or the first row
  bool has_header = true;
  std::string comment;  // lines that begin so are skipped
  Units units;
  std::optional<double> missing;
  std::optional<ColumnName> time, label;
  double time_unit = 1.0;  // s
  std::vector<MappedBody> bodies;
  std::vector<MappedMarker> markers;
};

ColumnMap ReadColumnMap(const std::string& path);

}  // namespace hexcal
