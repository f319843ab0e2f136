// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "report/readings.h"

namespace hexcal {

// What result.json says of one of base and tool.
struct CalibratedMount {
  Pose3d parent_from_child;
  // Of a small right motion, [m, rad]; nothing where the data do not determine all of it.
  std::optional<Matrix6d> covariance;
};

struct CalibratedPose {
  std::string label;
  double weight = 0.0;
  Vector6d residual;     // measured minus predicted, m and rad, frame of the tool
  std::string readings;  // by which it was measured (report/readings.h); empty: not said
};

// What other programs want to know of a calibration.
struct Calibration {
  std::string path;  // of result.json
  std::string dataset;
  CalibratedMount base;  // world from base
  CalibratedMount tool;  // platform from tool
  std::vector<CalibratedPose> poses;
};

// Reads a result.json. InputError where it is none, or of a later version.
Calibration ReadCalibration(const std::string& path);

// InputError where a pose was read otherwise than in the dataset of that path.
void RequireSameReadings(const Calibration& calibration,
                         const DatasetReadings& readings,
                         const std::string& dataset_path);

}  // namespace hexcal
