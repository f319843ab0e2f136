// SPDX-License-Identifier: BSD-3-Clause
#include "apps/export.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/output_folder.h"
#include "apps/usage_error.h"
#include "config/nearest_word.h"
#include "estimator/observations.h"
#include "report/export/formats.h"
#include "report/written_json.h"

namespace hexcal {
namespace {

const ExportFormat& RequireFormat(const std::string& name) {
  if (const ExportFormat* format = FindExportFormat(name)) return *format;
  std::string names;
  std::vector<std::string_view> known;
  for (const ExportFormat& format : ExportFormats()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
    known.push_back(format.name);
  }
  throw UsageError(
      fmt::format("export: FORMAT: found '{}', expected one of {}{}\nTry 'hexcal help "
                  "export'.",
                  name,
                  names,
                  DidYouMean(name, known)));
}

// A name of a frame goes into XML, YAML and command lines as it is.
std::string FrameName(const std::string& name, std::string_view flag) {
  const bool is_plain = name.find_first_not_of(
                            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-") ==
                            std::string::npos &&
                        name.find_first_of("-.") != 0;
  if (is_plain) return name;
  throw UsageError(
      fmt::format("export: --{}: found '{}', expected letters, digits, '_', '/', '.' "
                  "and '-'",
                  flag,
                  name));
}

FrameNames FramesFromFlags() {
  const std::vector<std::pair<std::string, std::string_view>> frames = {
      {FLAGS_world_frame, "world_frame"},
      {FLAGS_base_frame, "base_frame"},
      {FLAGS_platform_frame, "platform_frame"},
      {FLAGS_tool_frame, "tool_frame"}};
  for (std::size_t a = 0; a < frames.size(); ++a)
    for (std::size_t b = a + 1; b < frames.size(); ++b)
      if (frames[a].first == frames[b].first)
        throw UsageError(
            fmt::format("export: --{} and --{}: found '{}' twice, expected four names, "
                        "since a frame is in one place",
                        frames[a].second,
                        frames[b].second,
                        frames[a].first));
  return {FrameName(FLAGS_world_frame, "world_frame"),
          FrameName(FLAGS_base_frame, "base_frame"),
          FrameName(FLAGS_platform_frame, "platform_frame"),
          FrameName(FLAGS_tool_frame, "tool_frame")};
}

int RunExport(const std::vector<std::string>& files) {
  const ExportFormat& format = RequireFormat(files[0]);
  if (format.needs_dataset && FLAGS_dataset.empty())
    throw UsageError(
        fmt::format("export: --dataset=FILE is missing: {} has measured poses\nTry "
                    "'hexcal help export'.",
                    format.name));
  ExportInput input;
  input.frames = FramesFromFlags();
  input.calibration = ReadCalibration(files[1]);
  Observations observations;
  std::vector<std::string> inputs = {files[1]};
  if (format.needs_dataset) {
    const Dataset dataset = OpenDataset(FLAGS_dataset, true);
    RequireSameReadings(input.calibration, ReadingsOf(dataset), dataset.path);
    observations = MakeObservations(dataset);
    input.observations = &observations;
    for (std::string& file : InputFiles(dataset, "")) inputs.push_back(std::move(file));
  }
  std::vector<OutputFile> outputs;
  for (const std::string_view file : format.files)
    outputs.push_back({std::string(file), std::string(kExportMark)});
  OutputFolder folder(FLAGS_out, "", outputs, inputs, FLAGS_force);
  const ExportedFiles exported = format.write(input);
  folder.Write(exported);
  if (FLAGS_quiet) return kDone;
  const std::vector<std::string> paths = folder.PathsOf(exported);
  if (FLAGS_json)
    fmt::print("{}\n", WrittenJsonLine("export", paths, {}));
  else
    fmt::print("{}\n", fmt::join(paths, "\n"));
  return kDone;
}

std::string_view Description() {
  static const std::string text = [] {
    std::string all =
        "Writes a calibration (result.json) as other programs read it: base in world and tool on "
        "platform, or what is left over at every pose. The files go to DIR. Formats:";
    for (const ExportFormat& format : ExportFormats())
      all += fmt::format("\n  {}: {}", format.name, format.summary);
    return all;
  }();
  return text;
}

std::vector<std::string_view> ExportFormatNames() {
  std::vector<std::string_view> names;
  for (const ExportFormat& format : ExportFormats()) names.push_back(format.name);
  return names;
}

}  // namespace

Command ExportCommand() {
  return {"export",
          "a calibration for other programs",
          "FORMAT RESULT.json",
          2,
          2,
          Description(),
          {{"out", true, "DIR", "The files go to DIR."},
           {"dataset"},
           {"world_frame"},
           {"base_frame"},
           {"platform_frame"},
           {"tool_frame"},
           {"config"},
           {"json"},
           {"quiet"},
           {"force"}},
          &RunExport,
          {{"hexcal export urdf out/neurobot/result.json --base_frame=hexapod --out=out/urdf",
            "As fixed joints, the robot's base being called hexapod."},
           {"hexcal export tum out/neurobot/result.json --dataset=examples/neurobot/dataset.yaml "
            "--out=out/tum",
            "Measured and predicted poses, for evo."}},
          ExportFormatNames()};
}

}  // namespace hexcal
