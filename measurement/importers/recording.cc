// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/recording.h"

#include <fmt/format.h>

#include "measurement/checked_values.h"
#include "measurement/labels.h"

namespace hexcal {

void CheckReadings(std::size_t rows, std::size_t readings_a_row, const Location& where) {
  if (rows * std::max<std::size_t>(readings_a_row, 1) <= kMostImportReadings) return;
  throw InputError(where,
                   fmt::format("row {} of {} points and poses each", rows, readings_a_row),
                   fmt::format("at most {} points and poses in a file", kMostImportReadings));
}

void CheckPlace(const Recording& recording,
                std::size_t row,
                std::string_view name,
                const Eigen::Vector3d& place) {
  const double largest = place.cwiseAbs().maxCoeff();
  if (largest <= kLongestLength) return;
  throw InputError(
      {FileLocation(recording.path).file, recording.lines.empty() ? 0 : recording.lines[row], 0},
      fmt::format("a coordinate of {} of {:.3g} m{}",
                  Quoted(name),
                  largest,
                  recording.lines.empty() ? fmt::format(" in row {}", row + 1) : ""),
      "a length of at most 1000 km (--missing_value=X says what stands for not seen)");
}

void WarnOfZeros(Recording& recording) {
  std::size_t zeros = 0;
  for (const RecordedMarker& marker : recording.markers)
    for (const std::optional<Eigen::Vector3d>& point : marker.points)
      zeros += point && point->isZero(0.0) ? 1 : 0;
  if (zeros == 0) return;
  recording.warnings.push_back(
      fmt::format("{}: {} points are exactly 0 0 0; if that means not seen, give --missing_value=0",
                  recording.path,
                  zeros));
}

}  // namespace hexcal
