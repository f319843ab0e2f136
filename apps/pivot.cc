// SPDX-License-Identifier: BSD-3-Clause
#include "apps/pivot.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/record_of.h"
#include "apps/report_page.h"
#include "apps/usage_error.h"
#include "estimator/pivot.h"
#include "measurement/dataset_header.h"
#include "report/pivot_html.h"
#include "report/pivot_json.h"
#include "report/pivot_table.h"

namespace hexcal {
namespace {

constexpr std::string_view kPivotMark = R"("format": "hexcal/pivot/)";

bool IsTable(const std::string& file) { return std::filesystem::path(file).extension() == ".csv"; }

// Of --units, whose choices (apps/flags.cc) have let nothing else through.
Units UnitsFromFlag() {
  const std::size_t comma = FLAGS_units.find(',');
  return {FindLengthUnit(FLAGS_units.substr(0, comma))->factor,
          FindAngleUnit(FLAGS_units.substr(comma + 1))->factor};
}

Pivoting OpenPivoting(const std::string& file) {
  if (!IsTable(file)) {
    if (!FLAGS_units.empty() || !FLAGS_name.empty())
      throw UsageError("pivot: --units and --name go with a .csv table: other files state them");
    return ReadPivoting(file);
  }
  if (FLAGS_units.empty())
    throw UsageError(
        "pivot: --units=LENGTH,ANGLE is missing: a table does not state them\nTry 'hexcal help "
        "pivot'.");
  const std::string name =
      FLAGS_name.empty() ? std::filesystem::path(file).stem().string() : FLAGS_name;
  if (!IsFolderName(name))
    throw UsageError(
        fmt::format("pivot: --name: found '{}', expected letters, digits, '.', '_' and '-' only "
                    "(it becomes the name of a folder of results)",
                    name));
  return ReadPivotingTable(file, UnitsFromFlag(), name);
}

std::vector<std::string> InputsOf(const Dataset& dataset) {
  std::vector<std::string> files = {dataset.path};
  const auto& table = dataset.measurement->where.file;
  if (table && *table != dataset.path) files.push_back(*table);
  return files;
}

std::optional<NoiseLevels> NoiseFromFlags() {
  if (!(FLAGS_noise_position > 0)) return std::nullopt;
  return NoiseLevels{FLAGS_noise_position, FLAGS_noise_orientation};
}

void PrintWarnings(const std::string& name, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) PrintWarning(name + ": " + warning);
}

int RunPivot(const std::vector<std::string>& files) {
  const auto start = std::chrono::steady_clock::now();
  const Pivoting pivoting = OpenPivoting(files[0]);
  const Dataset& dataset = pivoting.dataset;
  PrintWarnings(dataset.name, dataset.warnings);
  PrintWarnings(dataset.name, pivoting.poses.warnings);
  const std::vector<std::string> inputs = InputsOf(dataset);
  std::vector<OutputFile> outputs = {{"pivot.json", std::string(kPivotMark)},
                                     {"run.json", std::string(kRunMark)}};
  if (FLAGS_report) outputs.push_back(ReportPage("pivot"));
  OutputFolder folder(FLAGS_out, dataset.name, outputs, inputs, FLAGS_force);
  PivotOptions options;
  options.reject_outliers = FLAGS_outliers == "reject";
  const PivotPoses poses = MakePivotPoses(pivoting, NoiseFromFlags());
  const PivotResult result = CalibratePivot(poses, options);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunRecord record = RecordOf("pivot", dataset, seconds, 1);
  record.inputs = inputs;
  std::vector<std::pair<std::string, std::string>> results = {
      {"pivot.json", PivotJson(dataset, result)}, {"run.json", RunJson(record)}};
  if (FLAGS_report)
    results.emplace_back("report.html", PivotHtml(dataset.name, record, poses, options, result));
  folder.Write(results);
  PrintWarnings(dataset.name, result.warnings);
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", PivotJsonLine(dataset, result));
  else if (!FLAGS_quiet)
    fmt::print("{}  {:<15}{}\n\n", PivotTable(dataset.name, result), "written to", folder.path());
  return result.IsTrustworthy() ? kDone : kNotTrusted;
}

}  // namespace

Command PivotCommand() {
  return {
      "pivot",
      "where the tool's tip is, by pivoting about it, and how sure that is",
      "FILE",
      1,
      1,
      "The tip rests in a divot while the tool is tilted about it. Takes the poses of the tool's "
      "frame T that the tracker saw, from a YAML file (docs/pivot.md) with poses or markers, or "
      "from a .csv table of poses (pose,x,y,z with angles, a quaternion or a matrix), and finds "
      "the tip in frame T and the pivot in the frame of the poses with their covariance, by "
      "maximum likelihood with errors in the rotations, too. Writes pivot.json, which a point in "
      "the requirement file of 'hexcal audit' may name, and run.json to DIR/<name>/, report.html "
      "with --report. Exit status 4: there is a result, but the poses do not tilt the tool enough "
      "to determine the tip.",
      {{"out", true, "DIR", "The results go to DIR/<name>/."},
       {"report"},
       {"units"},
       {"name", false, {}, "The name of a table's results; a YAML file states its own."},
       {"outliers"},
       {"noise_position"},
       {"noise_orientation"},
       {"config"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunPivot,
      {{"hexcal pivot examples/pivot/pivoting.yaml --outliers=reject --report --out=out",
        "The tip of a tool that was tilted about it."}},
  };
}

}  // namespace hexcal
