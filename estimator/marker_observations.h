// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "estimator/observations.h"
#include "measurement/dataset.h"
#include "residuals/marker_data.h"

namespace hexcal {

// How far repeated frames of one marker in one pose scatter about their mean (pure error): it needs
// no model.
struct PureError {
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  // along the tracker's axes, m^2
  int degrees_of_freedom = 0;                         // of each axis

  // 1-sigma of a reading along each axis, m; nothing where there are too few frames to tell one
  // axis from another, or where an axis does not scatter at all.
  std::optional<Eigen::Vector3d> Sigma() const;
};

// The readings of a dataset of kind markers for the likelihood, beside the observations that the
// same dataset gave.
struct MarkerObservations {
  MarkerData data;
  std::vector<int> item_of_pose;                   // index into Observations::items, or -1
  std::array<std::vector<std::string>, 2> labels;  // base/b1, ..., tool/t1, ...
  std::optional<Eigen::Vector3d> sigma;            // as stated, m
  PureError pure_error;

  int NumResiduals() const { return 3 * static_cast<int>(data.readings.size()); }
  // Without robot draws, each of which has a prior of its own.
  int NumParameters() const;
};

// observations must come from this dataset. Its poses are the ones used; under a static tracker
// the base markers seen in the others are read too.
MarkerObservations MakeMarkerObservations(const Dataset& dataset, const Observations& observations);

// The same without the poses whose items are not among some, which must be items of all in their
// order. Readings of a static tracker's base stay.
MarkerObservations Restricted(const MarkerObservations& markers,
                              const Observations& all,
                              const Observations& some);

}  // namespace hexcal
