// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// Which readings of the tracker belong to which pose of the robot.
enum class Pairing {
  kRows,   // row k of the tracker's files, one after another, to row k of the robot's
  kFiles,  // all rows of file k, as readings of one pose, to row k of the robot's
  kTime,   // a row to the robot's row that is nearest in time
  kLabels  // by the labels that both state
};

enum class ImportKind { kAny, kMarkers, kPoses };

// What a user says of the files.
struct AssembleOptions {
  std::string name = "imported";
  std::optional<Pairing> pairing;
  int frames = 1;            // kRows: so many rows of the tracker are readings of one pose
  double window = 0.05;      // kTime: a reading further off than this, s, belongs to no pose
  double time_offset = 0.0;  // kTime: the robot's clock plus this is the tracker's, s
  std::string base, tool;    // a body of the recording by name or alias, or markers A,B,C;
                             // base: "tracker" where no markers are on the base
  std::optional<StatedShape> base_shape, tool_shape;
  ImportKind kind = ImportKind::kAny;  // kAny: by markers where all is there for it
  bool robot_inverse = false;          // the robot's file states platform_from_base
  bool measured_inverse = false;       // the tracker's file states body_from_recording
  bool static_tracker = false;
  // kPoses, as a trial: the scalar of the tracker's quaternions at the other end, where the file
  // does not say at which it is.
  bool measured_other_scalar = false;
};

// The dataset and what was made of the files, in words, for its comments and for the screen.
struct Assembled {
  Dataset dataset;
  std::string robot, tracker;
  std::vector<std::string> bodies;
};

// tracker: one recording a file, in the order given; empty: a dataset of robot poses alone.
// InputError for what the files or the options lack, naming the flag of hexcal import that gives
// it.
Assembled Assemble(const Recording& robot,
                   const std::vector<Recording>& tracker,
                   const AssembleOptions& options);

}  // namespace hexcal
