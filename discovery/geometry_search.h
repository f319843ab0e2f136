// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "discovery/discovery.h"
#include "discovery/geometry_likelihood.h"
#include "model/nominal_hexapod.h"

namespace hexcal {

// The symmetric hexapod that best explains a gap by errors of its joints and legs.
struct GeometryFound {
  NominalHexapod nominal;
  double width = 0.0;     // 1-sigma of the errors that the data make likely, m
  double log_gain = 0.0;  // of GeometryLikelihood
  // Where the search ended: how the frames lie, and each number in sigmas of its prior.
  int orientation = 0;
  Eigen::Matrix<double, 7, 1> place = Eigen::Matrix<double, 7, 1>::Zero();
};

// Where hexapods are sought: sizes in units of how far the poses reach, each number of the drawing
// with a wide prior (radii of 1.2 to 9 times the reach with two chances in three, plates and height
// of like size, any angle of the pairs), z of the frames up or down, and the first pair of the base
// on x, on y or opposite to either.
class GeometrySearch {
 public:
  // reach: the largest distance of a pose from home, m. home_height: z of home, m.
  GeometrySearch(double reach, double home_height) : reach_(reach), home_height_(home_height) {}

  // Many draws of the prior, then BFGS (Ceres) from the best few. Nothing where no draw is better
  // than no errors at all.
  std::optional<GeometryFound> Find(const GeometryLikelihood& likelihood) const;

  // 95 % bounds of each number, given how the frames lie, by importance sampling about the best.
  std::vector<Bound> Bounds(const GeometryLikelihood& likelihood,
                            const GeometryFound& found,
                            std::uint64_t seed) const;

 private:
  const double reach_, home_height_;
};

}  // namespace hexcal
