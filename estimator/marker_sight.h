// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "model/corrections.h"

namespace hexcal {

// Where the tool was seen, rid of what the tracker and the markers do by given corrections.
struct Sight {
  std::vector<Pose3d> world_from_tool;  // of the rows asked for
  // What the rigid fits leave of the mean readings, each over its sigma: 3 x markers of a body,
  // row by row; of a static tracker all of the base's first. Empty where poses were measured or the
  // bodies' shapes are not known.
  Eigen::VectorXd misfit;
};

// A dataset's measurement, seen again and again with other corrections.
class MarkerSight {
 public:
  // rows: of robot_poses, whose tool frame is known (ComputeToolPoses). Keeps the dataset.
  MarkerSight(const Dataset& dataset, const std::vector<int>& rows);

  // corrections: of every row of robot_poses. NaN where they leave no reading possible.
  Sight See(const std::vector<Corrections<double>>& corrections) const;
  // Rows of misfit, and what is left of them when each fit has taken its six.
  int misfit_rows() const { return misfit_rows_; }
  int misfit_freedom() const { return misfit_freedom_; }

 private:
  struct MeanReading {
    int row, marker;
    Eigen::Vector3d p_in_tracker, sigma;
  };
  using Readings = std::vector<MeanReading>;

  Pose3d Fit(int body,
             const Readings& readings,
             const std::vector<Corrections<double>>& corrections,
             Eigen::VectorXd* misfit,
             int* filled) const;
  void Gather();

  const Dataset& dataset_;
  std::vector<int> rows_;
  // By body and place in rows_; of a static tracker the base's are all in the first.
  std::array<std::vector<Readings>, 2> readings_;
  int misfit_rows_ = 0, misfit_freedom_ = 0;
};

}  // namespace hexcal
