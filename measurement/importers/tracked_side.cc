// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/tracked_side.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/utf8.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr std::string_view kTracker = "tracker";
constexpr std::size_t kMostNames = 20;

bool IsCalled(const RecordedBody& body, const std::string& name) {
  return body.name == name ||
         std::find(body.aliases.begin(), body.aliases.end(), name) != body.aliases.end();
}

// What there is to choose from, for a message.
template <typename Items>
std::string Names(std::string_view what, const Items& items) {
  if (items.empty()) return fmt::format("no {}", what);
  std::string names;
  for (std::size_t i = 0; i < std::min(items.size(), kMostNames); ++i)
    names += fmt::format("{}{}", i == 0 ? "" : ", ", Quoted(items[i].name));
  return fmt::format("the {} {}{}", what, names, items.size() > kMostNames ? ", ..." : "");
}

[[noreturn]] void Refuse(const Recording& recording, const std::string& wanted, bool is_base) {
  const std::string flag = is_base ? "--base" : "--tool";
  const std::string found = fmt::format(
      "{} and {}", Names("bodies", recording.bodies), Names("markers", recording.markers));
  const std::string expected =
      fmt::format("{}=NAME of a body{}, or {}=A,B,C of markers, each name once in the file",
                  flag,
                  is_base ? ", --base=tracker where none is on the base" : "",
                  flag);
  throw InputError(
      FileLocation(recording.path),
      wanted.empty() ? found : fmt::format("{}, none of them {}", found, Quoted(wanted)),
      wanted.empty() ? "to be told which of them is the " + std::string(is_base ? "base" : "tool") +
                           ": " + expected
                     : expected);
}

// The one marker of this name, or -1.
int FindMarker(const Recording& recording, std::string_view name) {
  int found = -1;
  for (std::size_t i = 0; i < recording.markers.size(); ++i) {
    if (recording.markers[i].name != name) continue;
    if (found >= 0) return -1;
    found = static_cast<int>(i);
  }
  return found;
}

}  // namespace

TrackedSide ChooseSide(const Recording& recording, const std::string& wanted, bool is_base) {
  TrackedSide side;
  side.name = wanted;
  if (is_base && wanted == kTracker) {
    side.is_tracker = true;
    return side;
  }
  const RecordedBody* body = nullptr;
  for (const RecordedBody& candidate : recording.bodies)
    if (IsCalled(candidate, wanted)) body = &candidate;
  if (wanted.empty()) {
    const bool is_alone = recording.bodies.size() == 1 &&
                          recording.bodies.front().markers.size() == recording.markers.size();
    if (!is_alone) Refuse(recording, wanted, is_base);
    side.is_tracker = is_base;
    if (is_base) return side;
    body = &recording.bodies.front();
  }
  if (body != nullptr) {
    side.body = body->poses.empty() ? nullptr : body;
    side.markers = body->markers;
    side.name = body->name;
    return side;
  }
  std::string_view rest = wanted;
  while (true) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const int marker = FindMarker(recording, Trimmed(rest.substr(0, comma)));
    if (marker < 0 ||
        std::find(side.markers.begin(), side.markers.end(), marker) != side.markers.end())
      Refuse(recording, wanted, is_base);
    side.markers.push_back(marker);
    if (comma == rest.size()) return side;
    rest.remove_prefix(comma + 1);
  }
}

void CheckPlaces(const Recording& recording, const TrackedSide& side) {
  for (std::size_t row = 0; row < recording.rows; ++row) {
    if (side.body != nullptr && side.body->poses[row])
      CheckPlace(recording, row, side.body->name, side.body->poses[row]->translation);
    for (const int index : side.markers) {
      const RecordedMarker& marker = recording.markers[static_cast<std::size_t>(index)];
      if (marker.points[row]) CheckPlace(recording, row, marker.name, *marker.points[row]);
    }
  }
}

std::string CleanLabel(std::string_view name) {
  std::string clean = WithoutControls(Trimmed(name), '_');
  for (char& c : clean)
    if (c == ',' || c == '"') c = '_';
  if (!clean.empty() && clean.front() == '#') clean.front() = '_';
  return clean.empty() ? "_" : clean;
}

}  // namespace hexcal
