// SPDX-License-Identifier: BSD-3-Clause
#include "apps/predict.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/output_folder.h"
#include "apps/usage_error.h"
#include "measurement/dataset.h"
#include "model/machine.h"
#include "model/predict.h"
#include "report/written_json.h"

namespace hexcal {
namespace {

std::string PredictionTable(const Dataset& dataset, const std::vector<Pose3d>& world_from_tool) {
  std::string table(kPredictionMark);
  for (std::size_t i = 0; i < world_from_tool.size(); ++i) {
    const Eigen::Vector3d& t = world_from_tool[i].translation;
    const Eigen::Quaterniond& q = world_from_tool[i].rotation;
    fmt::format_to(std::back_inserter(table),
                   "{},{},{},{},{},{},{},{}\n",
                   dataset.robot_poses.rows[i].label,
                   t.x(),
                   t.y(),
                   t.z(),
                   q.w(),
                   q.x(),
                   q.y(),
                   q.z());
  }
  return table;
}

int RunPredict(const std::vector<std::string>& files) {
  const std::filesystem::path out = FLAGS_out;
  if (!out.has_filename())
    throw UsageError(
        fmt::format("predict: --out: found the folder '{}', expected a file", FLAGS_out));
  const Dataset dataset = OpenDataset(files[0], false);
  const Machine machine = ReadMachine(FLAGS_model);
  OutputFolder folder(out.has_parent_path() ? out.parent_path().string() : ".",
                      "",
                      {{out.filename().string(), std::string(kPredictionMark)}},
                      InputFiles(dataset, FLAGS_model),
                      FLAGS_force);
  const std::vector<Pose3d> world_from_tool = Predict(machine, dataset);
  folder.Write({{out.filename().string(), PredictionTable(dataset, world_from_tool)}});
  if (FLAGS_quiet) return kDone;
  if (FLAGS_json)
    fmt::print("{}\n",
               WrittenJsonLine("predict", {FLAGS_out}, {{"poses", world_from_tool.size()}}));
  else
    fmt::print("{}: {} poses predicted\n", FLAGS_out, world_from_tool.size());
  return kDone;
}

}  // namespace

Command PredictCommand() {
  return {
      "predict",
      "where the machine really is, by a calibrated model",
      "DATASET",
      1,
      1,
      "Reads the poses that the robot reported (robot_poses) and writes, for each, the pose of the "
      "tool in the world by the model: T_T^W = T_B^W T_A^B T_T^A, with the model's effects of the "
      "robot and its mounts. The dataset needs no measurement. The table has the columns "
      "pose,x,y,z,qw,qx,qy,qz, in m, the quaternion's scalar first.",
      {{"model", true},
       {"out", true, "FILE.csv", "The table to write."},
       {"config"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunPredict,
      {{"hexcal predict examples/neurobot-test/plan.yaml --model=out/neurobot/model.yaml "
        "--out=where.csv",
        "Where the calibrated machine is at other poses."}},
  };
}

}  // namespace hexcal
