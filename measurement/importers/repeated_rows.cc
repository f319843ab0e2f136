// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/repeated_rows.h"

#include <fmt/format.h>

#include <unordered_map>
#include <vector>

#include "measurement/labels.h"

namespace hexcal {
namespace {

// Rows by what should tell them apart: how many have that of an earlier one, and the first that
// does.
struct Repeats {
  std::size_t count = 0, first = 0, of = 0;
};

template <typename Key>
Repeats Find(const std::vector<Key>& keys) {
  Repeats repeats;
  std::unordered_map<Key, std::size_t> rows;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto [earlier, is_new] = rows.emplace(keys[i], i);
    if (is_new) continue;
    if (repeats.count++ == 0) repeats = {1, i, earlier->second};
  }
  return repeats;
}

std::string RowText(const Recording& recording, std::size_t row) {
  return recording.lines.empty() ? fmt::format("row {}", row + 1)
                                 : fmt::format("line {}", recording.lines[row]);
}

std::string Warning(const Recording& recording, const Repeats& repeats, const std::string& what) {
  const std::string more =
      repeats.count == 1 ? ""
      : repeats.count == 2
          ? ", another row that of an earlier one"
          : fmt::format(", {} other rows that of an earlier one", repeats.count - 1);
  return fmt::format("{}: {} has the {} of {}{}: is a reading there twice?",
                     recording.path,
                     RowText(recording, repeats.first),
                     what,
                     RowText(recording, repeats.of),
                     more);
}

}  // namespace

std::string RepeatedRows(const Recording& recording, bool labels_differ) {
  if (!recording.frames.empty()) {
    const Repeats repeats = Find(recording.frames);
    if (repeats.count > 0)
      return Warning(
          recording, repeats, fmt::format("frame number {}", recording.frames[repeats.first]));
  } else if (const Repeats repeats = Find(recording.times); repeats.count > 0) {
    return Warning(recording, repeats, "time");
  }
  const Repeats repeats = labels_differ ? Find(recording.labels) : Repeats();
  if (repeats.count == 0) return "";
  return Warning(recording, repeats, "label " + Quoted(recording.labels[repeats.first]));
}

}  // namespace hexcal
