// SPDX-License-Identifier: BSD-3-Clause
// where DATASET MODEL: where the tool is at every pose that the robot reports, in m.
#include <cstdio>

#include "config/input_error.h"
#include "measurement/dataset.h"
#include "model/machine.h"
#include "model/predict.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    const hexcal::Dataset dataset = hexcal::ReadDataset(argv[1], false);
    const hexcal::Machine machine = hexcal::ReadMachine(argv[2]);
    for (const hexcal::Pose3d& world_from_tool : hexcal::Predict(machine, dataset)) {
      const Eigen::Vector3d& p = world_from_tool.translation;
      std::printf("%.9f %.9f %.9f\n", p.x(), p.y(), p.z());
    }
  } catch (const hexcal::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
