// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command.h"

#include <algorithm>
#include <limits>

#include "apps/predict.h"
#include "apps/simulate.h"

namespace hexcal {
namespace {

const Command kPredict = {
    "predict",
    "where the machine really is, by a calibrated model",
    "DATASET",
    1,
    1,
    "Reads the poses that the robot reported (robot_poses) and writes, for each, the pose of the "
    "tool in the world by the model: T_T^W = T_B^W T_A^B T_T^A. The dataset needs no measurement. "
    "The table has the columns pose,x,y,z,qw,qx,qy,qz, in m, the quaternion's scalar first.",
    {{"model", true},
     {"out", true, "FILE.csv", "The table to write."},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunPredict,
};

const Command kSimulate = {
    "simulate",
    "what the tracker would see of a calibrated machine, as a new dataset",
    "DATASET",
    1,
    1,
    "Takes the machine of the model as the truth, moves it through the dataset's poses and writes "
    "what the tracker would see as a new dataset, in m and rad, with noise drawn from the standard "
    "deviations that the dataset states. The dataset's own measurement, if it has readings, is "
    "replaced.",
    {{"model", true},
     {"out", true, "DIR", "The new dataset goes to DIR/<name>/."},
     {"seed"},
     {"noise"},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunSimulate,
};

}  // namespace

const CommandFlag* Command::FindFlag(std::string_view flag) const {
  const auto found = std::find_if(
      flags.begin(), flags.end(), [flag](const CommandFlag& own) { return own.name == flag; });
  return found == flags.end() ? nullptr : &*found;
}

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {kPredict, kSimulate};
  return commands;
}

const Command* FindCommand(std::string_view name) {
  const std::vector<Command>& commands = Commands();
  const auto found = std::find_if(
      commands.begin(), commands.end(), [name](const Command& own) { return own.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace hexcal
