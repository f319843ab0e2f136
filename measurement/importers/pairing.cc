// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/pairing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kNanosecond = 1e-9;  // s
constexpr double kSettling = 0.2;     // of a stop, at its begin: readings in it are not used

using Rows = std::vector<std::vector<TrackerRow>>;

std::size_t TotalRows(const std::vector<Recording>& tracker) {
  std::size_t rows = 0;
  for (const Recording& file : tracker) rows += file.rows;
  return rows;
}

std::string Sizes(const Recording& robot, const std::vector<Recording>& tracker) {
  return fmt::format("{} rows in {} of the tracker and {} rows of the robot ({})",
                     TotalRows(tracker),
                     tracker.size() == 1 ? "one file" : fmt::format("{} files", tracker.size()),
                     robot.rows,
                     robot.path);
}

Location FirstFile(const std::vector<Recording>& tracker) {
  return FileLocation(tracker.front().path);
}

[[noreturn]] void RefuseUnsaid(const Recording& robot, const std::vector<Recording>& tracker) {
  throw InputError(
      FirstFile(tracker),
      Sizes(robot, tracker),
      "to be told how they belong together: --pair=rows (row k to row k; with --frames=N, N rows "
      "of the tracker to each of the robot), --pair=files (file k to row k), --pair=time (nearest "
      "in time) or --pair=labels");
}

Rows PairByOrder(const Recording& robot, const std::vector<Recording>& tracker, int frames) {
  const std::size_t each = static_cast<std::size_t>(frames);
  if (TotalRows(tracker) != each * robot.rows)
    throw InputError(FirstFile(tracker),
                     Sizes(robot, tracker),
                     frames == 1 ? "as many of one as of the other for --pair=rows"
                                 : fmt::format("{} of the tracker for each of the robot, as "
                                               "--frames={} says",
                                               frames,
                                               frames));
  Rows rows(robot.rows);
  std::size_t next = 0;
  for (std::size_t file = 0; file < tracker.size(); ++file)
    for (std::size_t row = 0; row < tracker[file].rows; ++row, ++next)
      rows[next / each].push_back({file, row});
  return rows;
}

Rows PairByFile(const Recording& robot, const std::vector<Recording>& tracker) {
  if (tracker.size() != robot.rows)
    throw InputError(FirstFile(tracker),
                     Sizes(robot, tracker),
                     "a file of the tracker for each row of the robot for --pair=files");
  Rows rows(robot.rows);
  for (std::size_t file = 0; file < tracker.size(); ++file)
    for (std::size_t row = 0; row < tracker[file].rows; ++row) rows[file].push_back({file, row});
  return rows;
}

void RequireTimes(const Recording& recording) {
  if (recording.times.size() == recording.rows) return;
  throw InputError(FileLocation(recording.path), "no times", "times of the rows for --pair=time");
}

// The robot's rows by time, in the tracker's clock.
class Stops {
 public:
  Stops(const Recording& robot, const AssembleOptions& options) : window_(options.window) {
    const auto offset = static_cast<std::int64_t>(std::llround(options.time_offset / kNanosecond));
    for (std::size_t i = 0; i < robot.rows; ++i) times_.emplace_back(robot.times[i] + offset, i);
    std::sort(times_.begin(), times_.end());
    for (const auto& [begin, end] : robot.spans) {
      const auto settling = static_cast<std::int64_t>(kSettling * static_cast<double>(end - begin));
      spans_.emplace_back(begin + settling + offset, end + offset);
    }
  }

  std::int64_t First() const { return times_.front().first; }
  std::int64_t Last() const { return times_.back().first; }

  // The robot's row to which a reading at this time belongs.
  std::optional<std::size_t> Find(std::int64_t time) const {
    if (!spans_.empty()) return FindSpan(time);
    auto next =
        std::lower_bound(times_.begin(), times_.end(), std::make_pair(time, std::size_t{0}));
    const bool has_nearer =
        next == times_.end() ||
        (next != times_.begin() && time - std::prev(next)->first < next->first - time);
    if (has_nearer) --next;
    const double distance = kNanosecond * static_cast<double>(std::abs(next->first - time));
    if (distance > window_) return std::nullopt;
    return next->second;
  }

 private:
  // Spans rise and do not overlap.
  std::optional<std::size_t> FindSpan(std::int64_t time) const {
    const auto next = std::partition_point(
        spans_.begin(), spans_.end(), [time](const auto& span) { return span.second < time; });
    if (next == spans_.end() || next->first > time) return std::nullopt;
    return static_cast<std::size_t>(next - spans_.begin());
  }

  double window_;  // s
  std::vector<std::pair<std::int64_t, std::size_t>> times_;
  std::vector<std::pair<std::int64_t, std::int64_t>> spans_;
};

Rows PairByTime(const Recording& robot,
                const std::vector<Recording>& tracker,
                const AssembleOptions& options) {
  RequireTimes(robot);
  for (const Recording& file : tracker) RequireTimes(file);
  const Stops stops(robot, options);
  Rows rows(robot.rows);
  bool any = false;
  for (std::size_t file = 0; file < tracker.size(); ++file) {
    for (std::size_t row = 0; row < tracker[file].rows; ++row) {
      const std::optional<std::size_t> stop = stops.Find(tracker[file].times[row]);
      if (!stop) continue;
      rows[*stop].push_back({file, row});
      any = true;
    }
  }
  if (any) return rows;
  const auto seconds = [](std::int64_t time) { return kNanosecond * static_cast<double>(time); };
  throw InputError(
      FirstFile(tracker),
      fmt::format("times from {:.3f} s on, the robot's being {:.3f} to {:.3f} s",
                  seconds(tracker.front().times.front()),
                  seconds(stops.First()),
                  seconds(stops.Last())),
      fmt::format("some within --window={} s of each other; --time_offset=S says what the "
                  "tracker's clock is ahead of the robot's",
                  options.window));
}

Rows PairByLabel(const Recording& robot, const std::vector<Recording>& tracker) {
  if (robot.labels.empty())
    throw InputError(FileLocation(robot.path), "no labels of rows", "labels for --pair=labels");
  std::unordered_map<std::string, std::size_t> row_of_label;
  for (std::size_t i = 0; i < robot.rows; ++i) row_of_label.emplace(robot.labels[i], i);
  Rows rows(robot.rows);
  for (std::size_t file = 0; file < tracker.size(); ++file) {
    const Recording& recording = tracker[file];
    if (recording.labels.empty())
      throw InputError(
          FileLocation(recording.path), "no labels of rows", "labels for --pair=labels");
    for (std::size_t row = 0; row < recording.rows; ++row) {
      const auto found = row_of_label.find(recording.labels[row]);
      if (found == row_of_label.end())
        throw InputError({FileLocation(recording.path).file,
                          recording.lines.empty() ? 0 : recording.lines[row],
                          0},
                         fmt::format("the label {}", Quoted(recording.labels[row])),
                         fmt::format("one that {} has", robot.path));
      rows[found->second].push_back({file, row});
    }
  }
  return rows;
}

}  // namespace

std::vector<std::vector<TrackerRow>> PairRows(const Recording& robot,
                                              const std::vector<Recording>& tracker,
                                              const AssembleOptions& options) {
  if (!options.pairing) RefuseUnsaid(robot, tracker);
  switch (*options.pairing) {
    case Pairing::kRows:
      return PairByOrder(robot, tracker, options.frames);
    case Pairing::kFiles:
      return PairByFile(robot, tracker);
    case Pairing::kTime:
      return PairByTime(robot, tracker, options);
    case Pairing::kLabels:
      break;
  }
  return PairByLabel(robot, tracker);
}

}  // namespace hexcal
