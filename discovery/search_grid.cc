// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/search_grid.h"

#include <glog/logging.h>

#include <algorithm>

namespace hexcal {
namespace {

constexpr int kEndPoses = 4;       // a step sets at least so many measured poses apart
constexpr double kFewest = 3.0;    // periods a travel: fewer look like a smooth curve
constexpr double kMost = 70.0;     // more are beyond what some 60 poses hold apart
constexpr double kSpacing = 0.28;  // of the frequency, in periods a travel

// Legs' range of travel, m: the widest of the six.
double TravelOf(const std::vector<Visit>& visits, const std::vector<int>& rows) {
  Vector6d least = visits[rows[0]].lengths, most = least;
  for (const int row : rows) {
    least = least.cwiseMin(visits[row].lengths);
    most = most.cwiseMax(visits[row].lengths);
  }
  return (most - least).maxCoeff();
}

std::vector<double> Periods(const std::vector<Visit>& visits, const std::vector<int>& rows) {
  std::vector<double> periods;
  const double travel = TravelOf(visits, rows);
  if (!(travel > 0.0)) return periods;
  for (double turns = kFewest; turns <= kMost; turns += kSpacing) periods.push_back(travel / turns);
  return periods;
}

std::vector<double> Times(const std::vector<Visit>& visits,
                          const std::vector<int>& rows,
                          bool is_row,
                          int stride) {
  std::vector<double> times;
  const auto time = [&](int row) {
    return is_row ? static_cast<double>(visits[row].row) : visits[row].time;
  };
  for (int k = kEndPoses; k + kEndPoses <= static_cast<int>(rows.size()); k += stride)
    times.push_back(0.5 * (time(rows[k - 1]) + time(rows[k])));
  return times;
}

}  // namespace

std::vector<double> GridFor(const EffectKind& kind,
                            const ParameterKind& parameter,
                            const std::vector<Visit>& visits,
                            const std::vector<int>& rows,
                            const EffectReference& reference) {
  const auto is_row = reference.find("time_is_row");
  const bool counts_rows = is_row != reference.end() && is_row->second[0] != 0.0;
  if (parameter.name == "period") return Periods(visits, rows);
  if (parameter.name == "time")
    return Times(visits, rows, counts_rows, kind.site == "marker" ? 4 : 1);
  CHECK(parameter.name == "time_constant") << kind.name << ": " << parameter.name;
  const auto time = [&](int row) { return counts_rows ? visits[row].row : visits[row].time; };
  double first = time(rows[0]), last = first;
  for (const int row : rows)
    first = std::min<double>(first, time(row)), last = std::max<double>(last, time(row));
  std::vector<double> constants;
  // Zero is the straight line, where the kind has one.
  if (parameter.scale == 0.0) constants.push_back(0.0);
  for (const double part : {0.05, 0.1, 0.2, 0.4}) constants.push_back(part * (last - first));
  return constants;
}

}  // namespace hexcal
