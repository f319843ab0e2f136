// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "discovery/discover.h"
#include "estimator/calibrate.h"
#include "estimator/method.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

// A truth and how it is measured: what one draw after another is simulated from.
struct StudyCell {
  std::string scenario;     // its name
  double noise = 1.0;       // factor on every noise that the dataset states
  int poses = 0;            // so many of the dataset's, drawn anew each time; 0: all
  double effects = 1.0;     // factor on the sizes of the truth's effects
  bool knows_noise = true;  // whether the estimators are told the measurement's noise

  Dataset dataset;  // its noises times the factor
  Machine truth;    // its effects times the factor
  // Where the tool is judged: reported poses, where it truly is, and, for poses that were measured,
  // where it was seen.
  Dataset test;
  std::vector<Pose3d> test_reported, test_true;
  std::vector<std::pair<int, Pose3d>> test_measured;  // by row of test

  int PosesADraw() const;
};

// One way from a draw to base and tool.
struct StudyEstimator {
  std::string name;
  bool discovers = false;
  Method method = Method::kNonlinear;  // else
  CalibrateOptions calibrate;
  DiscoverOptions discover;
};

struct Study {
  std::string name;
  std::uint64_t seed = 1;
  int draws = 0;    // of each cell
  int records = 0;  // so many first iterations are written, the start being the first
  std::vector<StudyCell> cells;
  std::vector<StudyEstimator> estimators;
};

// The cell of a scenario's dataset, truth and (null: the dataset itself) test. InputError where one
// has not what a simulation needs.
StudyCell MakeStudyCell(const std::string& scenario,
                        const Dataset& dataset,
                        const Machine& truth,
                        const Dataset* test,
                        double noise,
                        int poses,
                        double effects,
                        bool knows_noise);

// The seed of a task: of its number and of the study's name and seed, nothing else.
std::uint64_t SeedOf(const Study& study, std::int64_t task);

// What the estimators get in one draw: a new dataset whose poses and noise depend on the seed
// alone.
Dataset DrawDataset(const StudyCell& cell, std::uint64_t seed);

}  // namespace hexcal
