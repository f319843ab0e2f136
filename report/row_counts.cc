// SPDX-License-Identifier: BSD-3-Clause
#include "report/row_counts.h"

#include "measurement/marker_rows.h"
#include "measurement/tool_pose.h"

namespace hexcal {
namespace {

// What became of a robot pose; used, or why not.
enum class Fate { kUsed, kNoReading, kTooFewMarkers, kCollinearMarkers, kNoWeight };

const char* CodeOf(Fate fate) {
  switch (fate) {
    case Fate::kNoReading:
      return "no_reading";
    case Fate::kTooFewMarkers:
      return "too_few_markers";
    case Fate::kCollinearMarkers:
      return "collinear_markers";
    case Fate::kNoWeight:
      return "no_weight";
    case Fate::kUsed:
      break;
  }
  return "";
}

void AddReason(const std::string& code, long count, RowCount* rows) {
  if (count == 0) return;
  for (auto& [name, number] : rows->reasons)
    if (name == code) {
      number += count;
      return;
    }
  rows->reasons.emplace_back(code, count);
}

void Add(Fate fate, RowCount* rows) {
  if (fate == Fate::kUsed)
    ++rows->used;
  else
    ++(fate == Fate::kNoReading ? rows->missing : rows->rejected);
  if (fate != Fate::kUsed) AddReason(CodeOf(fate), 1, rows);
}

// Of every row of robot_poses. The estimate's poses stand in their order.
std::vector<Fate> FatesOf(const Dataset& dataset, const Estimate& estimate) {
  const auto& rows = dataset.robot_poses.rows;
  std::vector<Fate> fates(rows.size(), Fate::kNoReading);
  for (const LeftOutPose& out : ComputeToolPoses(dataset).left_out)
    fates[out.pose] = out.is_collinear ? Fate::kCollinearMarkers : Fate::kTooFewMarkers;
  std::size_t next = 0;
  for (std::size_t row = 0; row < rows.size() && next < estimate.poses.size(); ++row) {
    if (estimate.poses[next].label != rows[row].label) continue;
    fates[row] = estimate.poses[next++].weight > 0.0 ? Fate::kUsed : Fate::kNoWeight;
  }
  return fates;
}

std::vector<RowCount> CountMarkers(const Dataset& dataset, const std::vector<Fate>& fates) {
  const Measurement& measurement = *dataset.measurement;
  std::array<std::vector<RowCount>, 2> counts;
  for (int b = 0; b < 2; ++b)
    for (const std::string& marker : measurement.bodies[b].markers)
      counts[b].push_back({(b == 0 ? "base/" : "tool/") + marker, 0, 0, 0, 0, {}});
  for (const MarkerReading& reading : measurement.readings) {
    const bool is_common = reading.body == BodyId::kBase && dataset.tracker.is_static;
    RowCount& count = counts[static_cast<int>(reading.body)][reading.marker];
    ++count.given;
    Add(is_common ? Fate::kUsed : fates[reading.pose], &count);
  }
  std::vector<RowCount> all;
  const MarkerRows rows = CountMarkerRows(dataset);
  for (int b = 0; b < 2; ++b)
    for (std::size_t m = 0; m < counts[b].size(); ++m) {
      RowCount& count = counts[b][m];
      const long unseen = rows.unseen[b][m];
      count.given += unseen;
      const long absent = rows.frames - count.given;
      count.missing += unseen + absent;
      AddReason("not_seen", unseen, &count);
      AddReason("no_row", absent, &count);
      all.push_back(std::move(count));
    }
  return all;
}

}  // namespace

std::vector<RowCount> CountRows(const Dataset& dataset, const Estimate& estimate) {
  const std::vector<Fate> fates = FatesOf(dataset, estimate);
  RowCount robot{"robot poses", static_cast<long>(fates.size()), 0, 0, 0, {}};
  for (const Fate fate : fates) Add(fate, &robot);
  std::vector<RowCount> counts = {robot};
  const Measurement& measurement = *dataset.measurement;
  if (measurement.kind == Measurement::Kind::kMarkers) {
    const std::vector<RowCount> markers = CountMarkers(dataset, fates);
    counts.insert(counts.end(), markers.begin(), markers.end());
    return counts;
  }
  RowCount measured{"measured poses", static_cast<long>(measurement.poses.size()), 0, 0, 0, {}};
  for (const MeasuredPose& pose : measurement.poses) Add(fates[pose.pose], &measured);
  counts.push_back(measured);
  return counts;
}

}  // namespace hexcal
