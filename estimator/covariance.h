// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/information.h"
#include "residuals/pose_error.h"

namespace hexcal {

// The paper's y = [d_b, delta_b, d_a, delta_a], Eqs. (18)-(21): label and unit of every row of
// every covariance.
struct ParameterInfo {
  std::string_view name;
  bool is_angle;  // rad, else m
};
inline constexpr std::array<ParameterInfo, 12> kParameters = {{{"base.dx", false},
                                                               {"base.dy", false},
                                                               {"base.dz", false},
                                                               {"base.rx", true},
                                                               {"base.ry", true},
                                                               {"base.rz", true},
                                                               {"tool.dx", false},
                                                               {"tool.dy", false},
                                                               {"tool.dz", false},
                                                               {"tool.rx", true},
                                                               {"tool.ry", true},
                                                               {"tool.rz", true}}};

// What the data say of the directions in parameter space, from the SVD of the whitened Jacobian
// with its columns scaled to unit length (so that neither m against mm nor m against rad matters).
struct Observability {
  Vector12d singular_values = Vector12d::Zero();  // largest first
  double condition_number = 0.0;
  int null_directions = 0;
  std::array<bool, 12> determined = {};      // no share in a null direction
  std::vector<std::string> weak_directions;  // the null directions in words
};

struct CovarianceOptions {
  // A singular value below this part of the largest is numerically zero: it would take rotations
  // that differ by less than a microradian to tell the parameters apart.
  double smallest_ratio = 1e-6;
  // A direction whose one sigma is longer than this has left the range in which a covariance means
  // anything.
  double largest_sigma_m = 1.0;
  double largest_sigma_rad = 0.5;
  // How many times larger than the stated noise the residuals are; at least 1.
  double noise_scale = 1.0;
  // Orientation noise of the reported robot poses, rad: what rotations of this size tell is told by
  // noise.
  double robot_orientation_noise_rad = 0.0;
};

// Gathers the whitened rows of all poses as their R factor.
class JacobianFactor {
 public:
  // whitened = whitener * PoseErrorJacobian. Sums are taken in the order of calls.
  void Add(const Matrix6x12d& whitened) { rows_.Add(whitened); }
  Matrix12d R() { return rows_.R(); }  // upper triangular, 12 x 12

 private:
  RowFactor rows_{12};
};

struct ParameterCovariance {
  Matrix12d covariance = Matrix12d::Zero();  // (J' J)^-1 within the determined directions
  Observability observability;
};

ParameterCovariance ComputeCovariance(const Matrix12d& r_factor, const CovarianceOptions& options);

}  // namespace hexcal
