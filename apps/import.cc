// SPDX-License-Identifier: BSD-3-Clause
#include "apps/import.h"

#include <fmt/format.h>

#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/hand_edits.h"
#include "apps/import_conventions.h"
#include "apps/import_options.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/trial_read.h"
#include "apps/usage_error.h"
#include "config/nearest_word.h"
#include "config/utf8.h"
#include "measurement/dataset_writer.h"
#include "measurement/importers/assemble.h"
#include "measurement/importers/dataset_comments.h"
#include "measurement/importers/formats.h"
#include "measurement/importers/hexapod_file.h"
#include "measurement/importers/initial_guess.h"
#include "measurement/importers/stops.h"
#include "measurement/importers/yaml_poses.h"
#include "report/written_json.h"

namespace hexcal {
namespace {

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
  throw UsageError(
      fmt::format("import: {}: found '{}', expected one of {}{}\nTry 'hexcal help import'.",
                  what,
                  name,
                  FormatNames(),
                  format == nullptr ? DidYouMean(name, known) : ""));
}

const ImportFormat& RobotFormat() {
  if (!FLAGS_robot_format.empty()) return RequireRecordings(FLAGS_robot_format, "--robot_format");
  if (!FLAGS_robot_map.empty()) return *FindImportFormat("columns");
  const ImportFormat* format = RecogniseFormat(FLAGS_robot);
  if (format != nullptr && format->read_recording != nullptr) return *format;
  throw InputError(FileLocation(FLAGS_robot),
                   "a file that does not tell its format by its "
                   "beginning",
                   "--robot_format=FORMAT, one of " + FormatNames());
}

struct Sources {
  Recording robot;
  std::vector<Recording> tracker;
};

Sources ReadSources(const ImportFormat& format, const std::vector<std::string>& files) {
  Sources sources;
  const bool is_robot = FLAGS_robot.empty() && format.is_robot;
  if (FLAGS_robot.empty() && !is_robot)
    throw UsageError(
        "import: --robot=FILE is missing: the file of what the robot reported\nTry "
        "'hexcal help import'.");
  if (is_robot && files.size() > 1)
    throw UsageError(fmt::format("import: found {} files of a robot, expected one", files.size()));
  if (is_robot) {
    sources.robot = ReadRecording(format, files[0], RobotOptions());
    return sources;
  }
  for (const std::string& file : files)
    sources.tracker.push_back(ReadRecording(format, file, TrackerOptions()));
  sources.robot = ReadRecording(RobotFormat(), FLAGS_robot, RobotOptions());
  if (FLAGS_stops > 0.0) sources.robot = FindStops(sources.robot, FLAGS_stops);
  return sources;
}

std::string CommandText(const std::vector<std::string>& files) {
  std::string text(kImportedMark);
  for (const std::string& file : files) text += " " + Shorten(file);
  return text + "\n";
}

using NamedFiles = std::vector<std::pair<std::string, std::string>>;

NamedFiles FilesOf(const Assembled& assembled, const std::vector<std::string>& arguments) {
  NamedFiles files = WriteDataset(assembled.dataset);
  for (auto& [name, content] : files) {
    if (name == DatasetFiles().front().name)
      content = CommandText(arguments) + WithComments(content, assembled);
  }
  SignFiles(files, DatasetFiles().front().name);
  return files;
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

void PrintSummary(const Assembled& assembled,
                  const std::optional<Conventions>& conventions,
                  const std::string& path) {
  fmt::print("{}: {} robot poses{}\n",
             assembled.dataset.name,
             assembled.dataset.robot_poses.rows.size(),
             MeasuredText(assembled.dataset));
  fmt::print("  robot       {}\n", assembled.robot);
  if (!assembled.tracker.empty()) fmt::print("  tracker     {}\n", assembled.tracker);
  for (const std::string& body : assembled.bodies) fmt::print("  {}\n", body);
  if (conventions)
    fmt::print(
        "  conventions as stated, none of {} others fits much better; base and tool leave "
        "{:.3g} mm and {:.3g} mrad\n",
        conventions->tried - 1,
        1e3 * conventions->stated.rms_position,
        1e3 * conventions->stated.rms_orientation);
  fmt::print("  written to  {}\n", path);
}

std::vector<std::string> InputsOf(std::vector<std::string> files) {
  for (const std::string& file : {FLAGS_robot,
                                  FLAGS_base_body,
                                  FLAGS_tool_body,
                                  FLAGS_hexapod,
                                  FLAGS_map,
                                  FLAGS_robot_map,
                                  FLAGS_initial})
    if (!file.empty()) files.push_back(file);
  return files;
}

int RunImport(const std::vector<std::string>& files) {
  const ImportFormat& format = RequireRecordings(files[0], "FORMAT");
  const std::vector<std::string> own_files(files.begin() + 1, files.end());
  const Sources sources = ReadSources(format, own_files);
  const AssembleOptions options = AssembleOptionsFromFlags();
  Assembled assembled = Assemble(sources.robot, sources.tracker, options);
  if (!FLAGS_initial.empty())
    assembled.dataset.initial = GuessFrom(ReadEasyHandeye(FLAGS_initial), assembled.dataset);
  if (!FLAGS_hexapod.empty()) assembled.dataset.hexapod = ReadHexapodFile(FLAGS_hexapod);
  for (const std::string& warning : assembled.dataset.warnings) PrintWarning(warning);
  OutputFolder folder(FLAGS_out, "", DatasetFiles(), InputsOf(own_files), FLAGS_force);
  if (!FLAGS_force) RequireUnchanged(folder, DatasetFiles().front().name);
  const NamedFiles dataset_files = FilesOf(assembled, files);
  TryReading(dataset_files, assembled.dataset.measurement.has_value(), FLAGS_out);
  const std::optional<Conventions> conventions =
      CheckConventions(sources.robot,
                       sources.tracker,
                       options,
                       {!FLAGS_robot_map.empty(), !FLAGS_map.empty()},
                       assembled.dataset);
  folder.Write(dataset_files);
  if (FLAGS_quiet) return kDone;
  if (FLAGS_json)
    fmt::print("{}\n",
               WrittenJsonLine("import",
                               folder.PathsOf(dataset_files),
                               {{"poses", assembled.dataset.robot_poses.rows.size()}}));
  else
    PrintSummary(assembled, conventions, folder.PathOf(DatasetFiles().front().name));
  return kDone;
}

std::string_view Description() {
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

std::vector<std::string_view> ImportFormatNames() {
  std::vector<std::string_view> names;
  for (const ImportFormat& format : ImportFormats())
    if (format.read_recording != nullptr) names.push_back(format.name);
  return names;
}

}  // namespace

Command ImportCommand() {
  return {
      "import",
      "other programs' files to a dataset",
      "FORMAT FILE...",
      2,
      std::numeric_limits<std::size_t>::max(),
      Description(),
      {{"out", true, "DIR", "The dataset goes to DIR."},
       {"robot"},
       {"robot_format"},
       {"robot_rotation"},
       {"robot_columns"},
       {"robot_map"},
       {"robot_inverse"},
       {"base"},
       {"tool"},
       {"base_body"},
       {"tool_body"},
       {"measured_inverse"},
       {"map"},
       {"pair"},
       {"frames"},
       {"stops"},
       {"window"},
       {"time_offset"},
       {"missing_value"},
       {"kind"},
       {"static_tracker"},
       {"hexapod"},
       {"initial"},
       {"name"},
       {"config"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunImport,
      {{"hexcal import ndi_csv examples/ndi-and-pi/tracker.csv "
        "--robot=examples/ndi-and-pi/hexapod.dat --base=0x0A --tool=0x0B --pair=rows --out=bench",
        "A tracker's file and a robot's, row by row, to bench/dataset.yaml."}},
      ImportFormatNames()};
}

}  // namespace hexcal
