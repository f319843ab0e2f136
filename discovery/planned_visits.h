// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "discovery/covariate_settings.h"
#include "discovery/gap_model.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

// A machine at work on a dataset, ready to be asked about further visits.
struct PlanScene {
  Dataset dataset;               // with the machine's hexapod, if it has one
  Machine machine;               // without faults of the data: poses are as mended
  std::vector<Effect> effects;   // of the machine, its pose map among them
  std::vector<Pose3d> reported;  // of the dataset's rows, mended
  int measured = 0;              // poses with a measurement, as ComputeToolPoses counts
};

// InputError where the dataset does not say how it measures, lacks what an effect needs, or its
// legs reach no pose.
PlanScene MakePlanScene(const Dataset& dataset, const Machine& machine);

// Visits that could follow the dataset's own.
struct PlannedVisits {
  std::vector<Pose3d> base_from_platform;
  std::vector<std::vector<double>> covariates;  // of each: as the dataset's columns, SI
};

// Every pose with so many (at most) combinations of the covariates' settings, drawn evenly; time
// stands still in the middle of the new visits, of which there will be `count`.
PlannedVisits MakeVisitPool(const PlanScene& scene,
                            const std::vector<Pose3d>& poses,
                            int count,
                            int settings,
                            const ChosenSettings& chosen,
                            std::uint64_t seed);

// These visits in their order, at the times when they will be.
PlannedVisits InTime(const PlanScene& scene, PlannedVisits visits);

// The scene's dataset with these visits behind its own, as an exact tracker would see them.
// Labels: plan-1, plan-2, ...
Dataset WithVisits(const PlanScene& scene, const PlannedVisits& visits);

// robot_poses of these visits alone.
RobotPoses RobotPosesOf(const PlanScene& scene, const PlannedVisits& visits);

// GapData of WithVisits. Without a time column, visits of a pool (is_pool) all count as the middle
// one of `count`.
GapData GapDataOf(const PlanScene& scene,
                  const PlannedVisits& visits,
                  const Dataset& with_visits,
                  bool is_pool,
                  int count);

}  // namespace hexcal
