// SPDX-License-Identifier: BSD-3-Clause
#include "apps/import.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/usage_error.h"
#include "config/strict_yaml.h"
#include "config/utf8.h"
#include "measurement/dataset_writer.h"
#include "measurement/importers/assemble.h"
#include "measurement/importers/dataset_comments.h"
#include "measurement/importers/formats.h"
#include "measurement/importers/hexapod_file.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

// The first is the file that names the others.
const std::vector<OutputFile>& DatasetFiles() {
  static const std::vector<OutputFile> files = {{"dataset.yaml", std::string(kImportedMark)},
                                                {"poses.csv", ""},
                                                {"measured.csv", ""},
                                                {"markers.csv", ""}};
  return files;
}

std::string FormatNames() {
  std::string names;
  for (const ImportFormat& format : ImportFormats())
    if (format.read_recording != nullptr)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

const ImportFormat& RequireRecordings(std::string_view name, std::string_view what) {
  const ImportFormat* format = FindImportFormat(name);
  if (format != nullptr && format->read_recording != nullptr) return *format;
  std::vector<std::string_view> known;
  for (const ImportFormat& candidate : ImportFormats()) known.push_back(candidate.name);
  const std::string nearest = format == nullptr ? NearestWord(name, known) : "";
  throw UsageError(
      fmt::format("import: {}: found '{}', expected one of {}{}\nTry 'hexcal help import'.",
                  what,
                  name,
                  FormatNames(),
                  nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest)));
}

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

ImportOptions TrackerOptions() {
  ImportOptions options;
  if (Given("missing_value")) options.missing_value = FLAGS_missing_value;
  return options;
}

ImportOptions RobotOptions() {
  ImportOptions options;
  options.rotation_order = FLAGS_robot_rotation;
  if (!Given("robot_columns")) return options;
  options.columns = CutAtCommas(FLAGS_robot_columns);
  if (options.columns.size() != 6)
    throw UsageError(
        fmt::format("import: --robot_columns: found {} columns, expected 6, of x y z "
                    "and three angles",
                    options.columns.size()));
  return options;
}

std::optional<Pairing> PairingFromFlags() {
  if (FLAGS_pair == "rows") return Pairing::kRows;
  if (FLAGS_pair == "files") return Pairing::kFiles;
  if (FLAGS_pair == "time") return Pairing::kTime;
  if (FLAGS_pair == "labels") return Pairing::kLabels;
  return std::nullopt;
}

// Allowed characters only: it becomes the name of a folder of results.
std::string NameOfFolder(const std::string& out) {
  const fs::path path = fs::path(out).lexically_normal();
  std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (!is_letter && !(c >= '0' && c <= '9') && c != '.' && c != '_' && c != '-') c = '-';
  }
  return name.empty() || name == "." || name == ".." ? "imported" : name;
}

AssembleOptions OptionsFromFlags() {
  AssembleOptions options;
  options.name = FLAGS_name.empty() ? NameOfFolder(FLAGS_out) : FLAGS_name;
  options.pairing = PairingFromFlags();
  options.frames = FLAGS_frames;
  options.window = FLAGS_window;
  options.time_offset = FLAGS_time_offset;
  options.base = FLAGS_base;
  options.tool = FLAGS_tool;
  if (!FLAGS_base_body.empty()) options.base_shape = ReadMarkerShape(FLAGS_base_body);
  if (!FLAGS_tool_body.empty()) options.tool_shape = ReadMarkerShape(FLAGS_tool_body);
  if (FLAGS_kind == "markers") options.kind = ImportKind::kMarkers;
  if (FLAGS_kind == "poses") options.kind = ImportKind::kPoses;
  options.robot_inverse = FLAGS_robot_inverse;
  options.measured_inverse = FLAGS_measured_inverse;
  options.static_tracker = FLAGS_static_tracker;
  return options;
}

const ImportFormat& RobotFormat() {
  if (!FLAGS_robot_format.empty()) return RequireRecordings(FLAGS_robot_format, "--robot_format");
  const ImportFormat* format = RecogniseFormat(FLAGS_robot);
  if (format != nullptr && format->read_recording != nullptr) return *format;
  throw InputError(FileLocation(FLAGS_robot),
                   "a file that does not tell its format by its "
                   "beginning",
                   "--robot_format=FORMAT, one of " + FormatNames());
}

Assembled AssembleFiles(const ImportFormat& format, const std::vector<std::string>& files) {
  std::vector<Recording> recordings;
  const bool is_robot = FLAGS_robot.empty() && format.is_robot;
  if (FLAGS_robot.empty() && !is_robot)
    throw UsageError(
        "import: --robot=FILE is missing: the file of what the robot reported\nTry "
        "'hexcal help import'.");
  if (is_robot && files.size() > 1)
    throw UsageError(fmt::format("import: found {} files of a robot, expected one", files.size()));
  for (const std::string& file : files)
    recordings.push_back(ReadRecording(format, file, is_robot ? RobotOptions() : TrackerOptions()));
  if (is_robot) return Assemble(recordings.front(), {}, OptionsFromFlags());
  const Recording robot = ReadRecording(RobotFormat(), FLAGS_robot, RobotOptions());
  return Assemble(robot, recordings, OptionsFromFlags());
}

std::string CommandText(const std::vector<std::string>& files) {
  std::string text(kImportedMark);
  for (const std::string& file : files) text += " " + Shorten(file);
  return text + "\n";
}

void WriteFiles(const Assembled& assembled,
                const std::vector<std::string>& files,
                OutputFolder& folder) {
  // Tables first: the file that names them comes when they are there.
  std::string description;
  for (const auto& [name, content] : WriteDataset(assembled.dataset)) {
    if (name == DatasetFiles().front().name)
      description = content;
    else
      folder.Write(name, content);
  }
  folder.Write(DatasetFiles().front().name,
               CommandText(files) + WithComments(description, assembled));
}

std::string MeasuredText(const Dataset& dataset) {
  if (!dataset.measurement) return "";
  const Measurement& measurement = *dataset.measurement;
  if (measurement.kind == Measurement::Kind::kPoses)
    return fmt::format(", {} poses of the tool", measurement.poses.size());
  return fmt::format(", {} readings of {} + {} markers",
                     measurement.readings.size(),
                     measurement.bodies[0].markers.size(),
                     measurement.bodies[1].markers.size());
}

void PrintSummary(const Assembled& assembled, const std::string& path) {
  fmt::print("{}: {} robot poses{}\n",
             assembled.dataset.name,
             assembled.dataset.robot_poses.rows.size(),
             MeasuredText(assembled.dataset));
  fmt::print("  robot       {}\n", assembled.robot);
  if (!assembled.tracker.empty()) fmt::print("  tracker     {}\n", assembled.tracker);
  for (const std::string& body : assembled.bodies) fmt::print("  {}\n", body);
  fmt::print("  written to  {}\n", path);
}

}  // namespace

int RunImport(const std::vector<std::string>& files) {
  const ImportFormat& format = RequireRecordings(files[0], "FORMAT");
  const std::vector<std::string> sources(files.begin() + 1, files.end());
  Assembled assembled = AssembleFiles(format, sources);
  std::vector<std::string> inputs = sources;
  for (const std::string& file : {FLAGS_robot, FLAGS_base_body, FLAGS_tool_body, FLAGS_hexapod})
    if (!file.empty()) inputs.push_back(file);
  if (!FLAGS_hexapod.empty()) assembled.dataset.hexapod = ReadHexapodFile(FLAGS_hexapod);
  for (const std::string& warning : assembled.dataset.warnings) PrintWarning(warning);
  OutputFolder folder(FLAGS_out, "", DatasetFiles(), inputs, FLAGS_force);
  WriteFiles(assembled, files, folder);
  // As every other command will read it: what is odd in it shows now.
  const std::string path = folder.PathOf(DatasetFiles().front().name);
  OpenDataset(path, assembled.dataset.measurement.has_value());
  if (!FLAGS_quiet) PrintSummary(assembled, path);
  return kDone;
}

std::string_view ImportDescription() {
  static const std::string text = [] {
    std::string all =
        "Makes a dataset of what other programs recorded: FILES are the tracker's, --robot the "
        "robot's. What the files do not say is said by flags: which body is the base and which "
        "the tool, and which reading belongs to which pose. Writes dataset.yaml, with comments, "
        "and its tables to DIR. Formats:";
    for (const ImportFormat& format : ImportFormats())
      all += fmt::format("\n  {}: {}", format.name, format.summary);
    return all;
  }();
  return text;
}

}  // namespace hexcal
