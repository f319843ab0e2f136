// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "geometry/pose.h"
#include "residuals/marker_data.h"
#include "residuals/streamed_residual.h"

namespace hexcal {

using Matrix63d = Eigen::Matrix<double, 6, 3>;

// What one pose alone has to be estimated for: where the tracker stood (one for all poses under a
// static tracker, and then not here) and how far the platform really was from what was reported:
// base_from_platform [+] robot_root * robot_draw, robot_draw ~ N(0, I).
struct MarkerNuisance {
  Pose3d tracker_from_world;
  Vector6d robot_draw = Vector6d::Zero();
};

// The readings of one body in one pose, whitened and linearised by the twist of the body, right of
// tracker_from_body, and by its shape: residual = r - G twist - F shape.
struct BodyTerms {
  Matrix6d normal = Matrix6d::Zero();    // G' G
  Vector6d gradient = Vector6d::Zero();  // G' r
  double squared = 0.0;                  // r' r
  // Centroid bodies only.
  Matrix63d cross = Matrix63d::Zero();                       // G' F
  Eigen::Matrix3d shape_normal = Eigen::Matrix3d::Zero();    // F' F
  Eigen::Vector3d shape_gradient = Eigen::Vector3d::Zero();  // F' r
};

// The twist that these readings tell, given the shape: best - by_shape * shape, with a covariance.
struct BodyTwist {
  Matrix6d covariance = Matrix6d::Zero();
  Vector6d best = Vector6d::Zero();
  Matrix63d by_shape = Matrix63d::Zero();
};

// One pose at a linearisation point. Twists x of the world and y of the tool, right of their poses
// in the tracker, the robot's draw u and the small motions b, t of the mounts are related by
//   y = by_world x + by_base b + by_robot u + t.
// Where there are nuisances (x of a tracker that moves, u), the readings tell y and x with
// covariances and the prior tells u, so that
//   error = by_base b + t + (shapes, or x of a static tracker) + noise of covariance weight^-1:
// they are eliminated without a difference of large numbers.
struct PoseTerms {
  std::array<BodyTerms, 2> bodies;
  std::array<BodyTwist, 2> twists;
  Matrix6d by_world = Matrix6d::Zero(), by_base = Matrix6d::Zero(), by_robot = Matrix6d::Zero();
  Matrix6d weight = Matrix6d::Zero();
  Vector6d error = Vector6d::Zero();
  double squared = 0.0;       // of the readings and of the draw, whitened
  double squared_draw = 0.0;  // the latter alone
};

// d(error) by the unknowns, with the other sign.
using MarkerCarry = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, MarkerLayout::kMaxSize>;

// One pose's share of the likelihood of marker readings. sigma: of one reading, along the axes of
// the tracker, m. Keeps references.
class MarkerPoseLikelihood {
 public:
  MarkerPoseLikelihood(const MarkerData& data,
                       const Eigen::Vector3d& sigma,
                       const MarkerUnknowns& unknowns,
                       const MarkerPose& pose)
      : data_(data), sigma_(sigma), unknowns_(unknowns), pose_(pose) {}

  MarkerNuisance Start() const;
  PoseTerms Linearise(const MarkerNuisance& nuisance) const;
  // The nuisances that fit best with these unknowns, from the start, by Gauss-Newton with step
  // halving; terms are those at their end.
  MarkerNuisance Eliminate(PoseTerms* terms) const;

  // Adds what this pose tells of the unknowns, its nuisances eliminated, to a sum of the layout's
  // size.
  void AddReduced(const PoseTerms& terms, const MarkerLayout& layout, NormalEquations* sum) const;

  // Covariance of the tool pose that the readings of this pose are worth, right perturbation, frame
  // T; the common error of a static tracker is not in it. Zero where the tool was not seen.
  Matrix6d ToolCovariance(const PoseTerms& terms) const;

  // Degrees of freedom of the readings that the draw takes: the trace of what is told of it by
  // them, given the inverse of the reduced normal matrix of all poses.
  double DrawFreedom(const PoseTerms& terms,
                     const MarkerLayout& layout,
                     const Eigen::MatrixXd& inverse) const;

  // Measured minus predicted, m, tracker frame: use(index of the reading, misfit).
  template <typename Use>
  void ForEachMisfit(const MarkerNuisance& nuisance, Use&& use) const {
    const auto tracker_from_body = TrackerFromBodies(nuisance);
    for (int i = pose_.first_base; i < pose_.end; ++i) {
      const int body = i < pose_.first_tool ? 0 : 1;
      const MarkerMean& reading = data_.readings[i];
      const Eigen::Vector3d p = unknowns_.p_in_body[body].col(reading.marker);
      use(i, Eigen::Vector3d(reading.p_in_tracker - tracker_from_body[body] * p));
    }
  }

  bool HasTool() const { return pose_.end > pose_.first_tool; }

 private:
  bool HasNuisance() const {
    return HasTool() && (!data_.tracker_is_static || data_.has_robot_noise);
  }
  Vector6d RobotMotion(const MarkerNuisance& nuisance) const {
    return pose_.robot_root * nuisance.robot_draw;
  }
  std::array<Pose3d, 2> TrackerFromBodies(const MarkerNuisance& nuisance) const;
  BodyTerms LineariseBody(int body, const Pose3d& tracker_from_body) const;
  void CloseLoop(const MarkerNuisance& nuisance, PoseTerms* terms) const;
  MarkerNuisance Moved(const MarkerNuisance& nuisance,
                       const PoseTerms& terms,
                       double factor,
                       double* decrement) const;
  MarkerCarry CarryOf(const PoseTerms& terms, const MarkerLayout& layout) const;

  const MarkerData& data_;
  const Eigen::Vector3d sigma_;
  const MarkerUnknowns& unknowns_;
  const MarkerPose& pose_;
};

}  // namespace hexcal
