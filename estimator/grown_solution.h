// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimator/grown_fit.h"
#include "estimator/observations.h"
#include "measurement/dataset.h"
#include "model/visit.h"

namespace hexcal {

// A joint fit of base, tool and effects with all that it was made of. Stays where it is, as parts
// of it refer to others.
struct GrownSolution {
  GrownSolution() = default;
  GrownSolution(const GrownSolution&) = delete;
  GrownSolution& operator=(const GrownSolution&) = delete;

  std::shared_ptr<const Dataset> dataset;  // the caller's, or a copy of it with markers mended
  std::optional<HexapodGeometry> hexapod;  // nominal
  Pose3d home;                             // the centre of the travel
  std::vector<Visit> visits;               // of all rows
  std::vector<int> rows;                   // of the observations
  Observations observations;               // faults of the robot's poses mended
  Observations cleaned;                    // without effects: base and tool alone explain them
  GrownProblem::Data data;                 // with the noise of the last fit
  std::vector<GrownEffect> effects;        // as they went into the last fit
  GrownFit fit;
  bool is_noise_estimated = false;
  double noise_scale = 1.0;  // of the last fit's noise; 1 where it is stated
  // Of a tracker that stood still: its common error, which moves the base alone.
  Matrix6d common = Matrix6d::Zero();

  GrownProblem Problem() const { return GrownProblem(data, effects); }
  // Of the 12 and the free numbers, common error in it: the one to use, and with the noise as the
  // fit took it.
  Eigen::MatrixXd Covariance() const { return With(noise_scale * noise_scale * fit.covariance); }
  Eigen::MatrixXd CovarianceUnscaled() const { return With(fit.covariance); }
  // What the error of a point of the tool leaves out: what of the model is not estimated, and what
  // the data do not determine, in words.
  std::vector<std::string> Held() const;
  std::vector<std::string> NotDetermined() const;

 private:
  Eigen::MatrixXd With(Eigen::MatrixXd covariance) const {
    covariance.topLeftCorner<6, 6>() += common;
    return covariance;
  }
};

}  // namespace hexcal
