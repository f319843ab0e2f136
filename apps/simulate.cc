// SPDX-License-Identifier: BSD-3-Clause
#include "apps/simulate.h"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/output_folder.h"
#include "measurement/dataset.h"
#include "measurement/dataset_writer.h"
#include "model/machine.h"
#include "model/simulate.h"
#include "report/written_json.h"

namespace hexcal {
namespace {

// The first is the file that names the others.
const std::vector<OutputFile>& DatasetFiles() {
  static const std::vector<OutputFile> files = {{"dataset.yaml", std::string(kSimulatedMark)},
                                                {"poses.csv", ""},
                                                {"measured.csv", ""},
                                                {"markers.csv", ""}};
  return files;
}

SimulateOptions OptionsFromFlags() {
  SimulateOptions options;
  options.seed = static_cast<std::uint64_t>(FLAGS_seed);
  options.noise = FLAGS_noise;
  return options;
}

int RunSimulate(const std::vector<std::string>& files) {
  const Dataset dataset = OpenDataset(files[0], false);
  const Machine machine = ReadMachine(FLAGS_model);
  OutputFolder folder(
      FLAGS_out, dataset.name, DatasetFiles(), InputFiles(dataset, FLAGS_model), FLAGS_force);
  const Dataset simulated = Simulate(dataset, machine, OptionsFromFlags());
  std::vector<std::pair<std::string, std::string>> written = WriteDataset(simulated);
  for (auto& [name, content] : written) {
    if (name == DatasetFiles().front().name)
      content = fmt::format(
          "{} --seed={} --noise={}\n{}", kSimulatedMark, FLAGS_seed, FLAGS_noise, content);
  }
  folder.Write(written);
  if (FLAGS_quiet) return kDone;
  const std::size_t poses = simulated.robot_poses.rows.size();
  if (FLAGS_json)
    fmt::print("{}\n", WrittenJsonLine("simulate", folder.PathsOf(written), {{"poses", poses}}));
  else
    fmt::print("{}: {} poses simulated\n", folder.PathOf(DatasetFiles().front().name), poses);
  return kDone;
}

}  // namespace

Command SimulateCommand() {
  return {
      "simulate",
      "what the tracker would see of a calibrated machine, as a new dataset",
      "DATASET",
      1,
      1,
      "Takes the machine of the model as the truth, moves it through the dataset's poses and "
      "writes "
      "what the tracker would see as a new dataset, in m and rad, with noise drawn from the "
      "standard "
      "deviations that the dataset states. The dataset's own measurement, if it has readings, is "
      "replaced.",
      {{"model", true},
       {"out", true, "DIR", "The new dataset goes to DIR/<name>/."},
       {"seed"},
       {"noise"},
       {"config"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunSimulate,
      {{"hexcal simulate examples/neurobot/plan.yaml --model=examples/neurobot/truth.yaml --seed=7 "
        "--out=again",
        "What the tracker would see of a known machine."}},
  };
}

}  // namespace hexcal
