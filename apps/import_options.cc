// SPDX-License-Identifier: BSD-3-Clause
#include "apps/import_options.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/usage_error.h"
#include "measurement/importers/formats.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

bool Given(std::string_view flag) { return WasGiven(*FindFlag(flag)); }

std::vector<std::string> CutAtCommas(const std::string& text) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, comma - begin));
    if (comma == text.size()) return words;
    begin = comma + 1;
  }
}

std::optional<Pairing> PairingFromFlags() {
  if (FLAGS_pair == "rows") return Pairing::kRows;
  if (FLAGS_pair == "files") return Pairing::kFiles;
  if (FLAGS_pair == "time") return Pairing::kTime;
  if (FLAGS_pair == "labels") return Pairing::kLabels;
  return std::nullopt;
}

}  // namespace

std::string NameOfFolder(const std::string& out) {
  const fs::path path = fs::path(out).lexically_normal();
  std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!is_letter && !(c >= '0' && c <= '9') && c != '.' && c != '_' && c != '-') c = '-';
  }
  return name.empty() || name == "." || name == ".." ? "imported" : name;
}

ImportOptions TrackerOptions() {
  ImportOptions options;
  options.map = FLAGS_map;
  if (Given("missing_value")) options.missing_value = FLAGS_missing_value;
  return options;
}

ImportOptions RobotOptions() {
  ImportOptions options;
  for (const std::string_view flag : {"robot_rotation", "robot_columns"})
    if (!FLAGS_robot_map.empty() && Given(flag))
      throw UsageError(fmt::format(
          "import: found --{} beside --robot_map, expected one of them: the map says it", flag));
  options.rotation_order = FLAGS_robot_rotation;
  options.map = FLAGS_robot_map;
  if (!Given("robot_columns")) return options;
  options.columns = CutAtCommas(FLAGS_robot_columns);
  if (options.columns.size() != 6)
    throw UsageError(
        fmt::format("import: --robot_columns: found {} columns, expected 6, of x y z "
                    "and three angles",
                    options.columns.size()));
  return options;
}

AssembleOptions AssembleOptionsFromFlags() {
  AssembleOptions options;
  options.name = FLAGS_name.empty() ? NameOfFolder(FLAGS_out) : FLAGS_name;
  if (options.name != NameOfFolder(options.name))
    throw UsageError(fmt::format(
        "import: --name: found '{}', expected letters, digits, '.', '_' and '-'", options.name));
  options.pairing = PairingFromFlags();
  options.frames = FLAGS_frames;
  options.window = FLAGS_window;
  options.time_offset = FLAGS_time_offset;
  options.base = FLAGS_base;
  options.tool = FLAGS_tool;
  if (!FLAGS_base_body.empty()) options.base_shape = ReadStatedShape(FLAGS_base_body);
  if (!FLAGS_tool_body.empty()) options.tool_shape = ReadStatedShape(FLAGS_tool_body);
  if (FLAGS_kind == "markers") options.kind = ImportKind::kMarkers;
  if (FLAGS_kind == "poses") options.kind = ImportKind::kPoses;
  options.robot_inverse = FLAGS_robot_inverse;
  options.measured_inverse = FLAGS_measured_inverse;
  options.static_tracker = FLAGS_static_tracker;
  return options;
}

}  // namespace hexcal
