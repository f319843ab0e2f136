// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/marker_rows.h"

#include <algorithm>
#include <set>
#include <string>
#include <unordered_set>

#include "config/strict_yaml.h"
#include "config/table.h"
#include "measurement/marker_body_reader.h"

namespace hexcal {
namespace {

class Counting {
 public:
  explicit Counting(const Measurement& measurement) : measurement_(measurement) {
    for (int b = 0; b < 2; ++b) rows_.unseen[b].assign(measurement.bodies[b].markers.size(), 0);
  }

  MarkerRows Count(TableReader table) {
    const int pose = table.Column("pose"), frame = table.Column("frame");
    std::unordered_set<std::string> frames;
    std::string key, last;
    while (table.Next()) {
      if (table.Empty(table.Column("x"))) AddUnseen(table);
      key.assign(table.Text(pose));
      if (frame >= 0) (key += '\n') += table.Text(frame);  // no label has a line break
      if (key != last) frames.insert(last = key);
    }
    rows_.frames = static_cast<long>(frames.size());
    return rows_;
  }

  MarkerRows CountReadings() {
    std::set<std::pair<int, int>> frames;
    for (const MarkerReading& reading : measurement_.readings)
      frames.emplace(reading.pose, reading.frame);
    rows_.frames = static_cast<long>(frames.size());
    return rows_;
  }

 private:
  void AddUnseen(const TableReader& table) {
    const int body = table.Text(table.Column("body")) == kBodyNames[0] ? 0 : 1;
    const auto& names = measurement_.bodies[body].markers;
    const auto found = std::find(names.begin(), names.end(), table.Text(table.Column("marker")));
    if (found != names.end()) ++rows_.unseen[body][found - names.begin()];
  }

  const Measurement& measurement_;
  MarkerRows rows_;
};

}  // namespace

MarkerRows CountMarkerRows(const Dataset& dataset) {
  const Measurement& measurement = *dataset.measurement;
  Counting counting(measurement);
  const auto& file = measurement.where.file;
  if (!file) return counting.CountReadings();
  if (*file != dataset.path) return counting.Count(TableReader::FromFile(*file));
  const YamlNode root = ParseYamlFile(dataset.path);
  for (const auto& [key, value] : root.entries)
    if (key.scalar == "measurement")
      for (const auto& [name, rows] : value.entries)
        if (name.scalar == "rows") return counting.Count(TableReader::FromRows(rows));
  return counting.CountReadings();
}

}  // namespace hexcal
