// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "measurement/dataset.h"
#include "model/corrections.h"
#include "model/forward.h"
#include "model/machine.h"
#include "model/visit.h"

namespace hexcal {

// Which effects of a machine act: predictions are of robot and mounts alone.
enum class EffectSites { kAll, kRobotAndMounts };

// The machine's hexapod, else the dataset's, else null.
const HexapodGeometry* HexapodOf(const Dataset& dataset, const Machine& machine);

// The rows of a dataset as a machine with effects goes through them, one after another. Refers to
// its arguments.
class MachineRows {
 public:
  // reported: faults of the data mended. InputError where the dataset lacks what an effect needs.
  MachineRows(const Dataset& dataset,
              const Machine& machine,
              const std::vector<Pose3d>& reported,
              EffectSites sites);

  struct Row {
    Visit visit;
    Corrections<double> corrections;  // the pose map's among them
  };
  // At most as often as there are rows.
  Row Next();

  // Where the machine puts the platform and the tool in this row. InputError where legs reach no
  // pose.
  ForwardPose Forward(const Row& row) const;

 private:
  const Dataset& dataset_;
  const Machine& machine_;
  const HexapodGeometry* hexapod_;
  std::vector<Effect> effects_;
  VisitSequence visits_;
};

}  // namespace hexcal
