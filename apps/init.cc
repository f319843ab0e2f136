// SPDX-License-Identifier: BSD-3-Clause
#include "apps/init.h"

#include <fmt/format.h>

#include <string>

#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/hand_edits.h"
#include "apps/import_options.h"
#include "apps/init_texts.h"
#include "apps/output_folder.h"
#include "apps/usage_error.h"
#include "report/written_json.h"

namespace hexcal {
namespace {

constexpr std::string_view kMark = "# Written by hexcal init.";
constexpr std::string_view kName = "name: my-machine";

std::string DatasetName() {
  const std::string name = FLAGS_name.empty() ? NameOfFolder(FLAGS_out) : FLAGS_name;
  if (name == NameOfFolder(name)) return name;
  throw UsageError(fmt::format(
      "init: --name: found '{}', expected letters, digits, '.', '_' and '-'", FLAGS_name));
}

std::string Named(std::string_view description, const std::string& name) {
  std::string text(description);
  return text.replace(text.find(kName), kName.size(), "name: \"" + name + "\"");
}

int RunInit(const std::vector<std::string>& /*files*/) {
  const bool by_poses = FLAGS_kind == "poses";
  const std::string table = by_poses ? "measured.csv" : "markers.csv";
  const std::string description =
      Named(by_poses ? InitPosesYaml() : InitMarkersYaml(), DatasetName());
  OutputFolder folder(FLAGS_out,
                      "",
                      {{"dataset.yaml", std::string(kMark)}, {"poses.csv", ""}, {table, ""}},
                      {},
                      FLAGS_force);
  if (!FLAGS_force) RequireUnchanged(folder, "dataset.yaml");
  std::vector<std::pair<std::string, std::string>> written = {
      {"dataset.yaml", description},
      {"poses.csv", std::string(InitRobotTable())},
      {table, std::string(by_poses ? InitMeasuredTable() : InitMarkersTable())}};
  SignFiles(written, "dataset.yaml");
  folder.Write(written);
  if (FLAGS_quiet) return kDone;
  const std::vector<std::string> paths = folder.PathsOf(written);
  if (FLAGS_json)
    fmt::print("{}\n", WrittenJsonLine("init", paths, {}));
  else
    fmt::print("{}\n", fmt::join(paths, "\n"));
  return kDone;
}

}  // namespace

Command InitCommand() {
  return {"init",
          "a dataset to start from, with comments",
          "",
          0,
          0,
          "Writes dataset.yaml, in which comments explain every key, units and the meaning of "
          "angles, and two small tables to DIR. Other commands take it as it is, with its "
          "simulated numbers; put your own in their place.",
          {{"out", true, "DIR", "The dataset goes to DIR."},
           {"kind", false, {}, "What the tracker measures: markers (any: the same), or poses."},
           {"name", false, {}, "The name of the dataset."},
           {"config"},
           {"json"},
           {"quiet"},
           {"force"}},
          &RunInit,
          {{"hexcal init --out=mine && hexcal calibrate mine/dataset.yaml --out=out",
            "A dataset, and its calibration."}}};
}

}  // namespace hexcal
