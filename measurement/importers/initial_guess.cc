// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/initial_guess.h"

namespace hexcal {

InitialGuess GuessFrom(const StoredTransform& stored, const Dataset& dataset) {
  if (!dataset.measurement || dataset.measurement->poses.empty())
    throw InputError(FileLocation(stored.path),
                     "a calibration of one of base and tool",
                     "a dataset of measured poses, from which the other follows (--kind=poses)");
  const MeasuredPose& first = dataset.measurement->poses.front();
  const Pose3d& base_from_platform =
      dataset.robot_poses.rows[static_cast<std::size_t>(first.pose)].base_from_platform;
  InitialGuess guess;
  if (stored.is_tool) {
    guess.platform_from_tool = stored.parent_from_child;
    guess.world_from_base =
        first.world_from_tool * (base_from_platform * guess.platform_from_tool).Inverse();
  } else {
    guess.world_from_base = stored.parent_from_child.Inverse();
    guess.platform_from_tool =
        (guess.world_from_base * base_from_platform).Inverse() * first.world_from_tool;
  }
  return guess;
}

}  // namespace hexcal
