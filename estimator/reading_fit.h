// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/marker_solver.h"
#include "estimator/reading_rows.h"
#include "estimator/subset_fit.h"

namespace hexcal {

// One marker's mean reading in one pose against all others of the fit.
struct ReadingTest {
  int pose = 0;                                        // of MarkerData::poses
  int reading = 0;                                     // of MarkerData::readings
  Eigen::Vector3d held_out = Eigen::Vector3d::Zero();  // measured - predicted by the others, m, M
  double squared = 0.0;     // the same in squared sigmas, externally studentised; 3 expected
  double p_value = 1.0;     // that a clean one is as far off
  double unit = 0.0;        // length, m, along the worst direction, of an error of one sigma
  double redundancy = 0.0;  // the part of an error that shows in the residual, mean of the three
};

// The fit by markers without some of the readings, to first order from the fit to all, and what it
// says of every reading: v and S, whitened residual and its covariance in the joint fit of what is
// common to the poses and what is each pose's own; a reading of the fit is S^-1 v off what the
// others predict, v' S^-1 v squared sigmas (Cook and Weisberg 1982, 2.2).
class ReadingFit {
 public:
  // cut: poses of which the tool is to stand anywhere. All must outlive it.
  ReadingFit(const MarkerObservations& markers,
             const MarkerSolution& solution,
             const std::vector<bool>& cut);

  // out: of each reading, whether it is left out. Then the tests are of that fit.
  void Fit(const std::vector<bool>& out);
  const std::vector<ReadingTest>& tests() const { return tests_; }
  int unchecked() const { return unchecked_; }  // readings that no others check
  NoiseBasis basis() const { return basis_; }

 private:
  // How one pose's readings stand in it.
  struct InPose {
    ReadingRows rows;
    Eigen::MatrixXd own_inverse;  // of the normal matrix of what is this pose's own
    Eigen::MatrixXd own_by_globals;
    Eigen::MatrixXd reduced;   // globals, less what the pose's own takes of them
    Eigen::VectorXd own_step;  // of its own where the globals stand still
  };
  struct Left {
    int pose, reading;
    Eigen::Vector3d residual;  // whitened
    Eigen::Matrix3d of_fit;    // covariance of the prediction, whitened
    Eigen::Vector3d sigma;
  };

  InPose At(std::size_t pose) const;
  void Step();
  std::vector<Left> Residuals();
  double DrawFreedom(const InPose& at) const;
  void SetScale(double squares, double freedom);
  void Test(const Left& one);
  double Tail(bool is_out, double* squared) const;

  const MarkerObservations& markers_;
  const MarkerData& data_;
  const MarkerLayout layout_;
  const MarkerSolution& solution_;
  const std::vector<bool>& cut_;
  MarkerUnknowns unknowns_;
  std::vector<bool> out_;
  Eigen::MatrixXd inverse_;  // of the reduced normal matrix of the globals
  Eigen::VectorXd step_;     // of the globals
  NoiseBasis basis_ = NoiseBasis::kStated;
  double scale_ = 1.0, freedom_ = 0.0;
  std::vector<ReadingTest> tests_;
  int unchecked_ = 0;
};

}  // namespace hexcal
