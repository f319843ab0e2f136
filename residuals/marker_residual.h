// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/dynamic_autodiff_cost_function.h>

#include "geometry/pose.h"
#include "residuals/marker_data.h"

namespace hexcal {

// One marker reading against its prediction, whitened, dimensionless, for Ceres's automatic
// derivatives:
//   base: residual = weight (measured - tracker_from_world b)
//   tool: residual = weight (measured - tracker_from_world world_from_base (base_from_platform [+]
//                    robot_root robot_draw) platform_from_tool t)
// Parameter blocks, in this order, those in brackets where they exist: tool: world_from_base (7),
// platform_from_tool (7); both: the nuisances (7 tracker_from_world, 6 robot_draw, or 13 for both
// in one, on the product of their manifolds), tracker_from_world of a static tracker (7), shape of
// a centroid body (3).
class MarkerResidual {
 public:
  using Cost = ceres::DynamicAutoDiffCostFunction<MarkerResidual, 4>;

  // weight: one over sigma of this mean reading, along the axes of the tracker, 1/m.
  MarkerResidual(const MarkerData& data,
                 const MarkerPose& pose,
                 int body,
                 const MarkerMean& reading,
                 const Eigen::Vector3d& weight)
      : data_(data), pose_(pose), body_(body), reading_(reading), weight_(weight) {}

  bool HasRobotDraw() const { return body_ == 1 && data_.has_robot_noise; }

  template <typename T>
  bool operator()(T const* const* parameters, T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    using Vector6 = Eigen::Matrix<T, 6, 1>;
    const T* const* next = parameters;
    const T* base = body_ == 1 ? *next++ : nullptr;
    const T* tool = body_ == 1 ? *next++ : nullptr;
    const bool has_nuisance = !data_.tracker_is_static || HasRobotDraw();
    const T* nuisance = has_nuisance ? *next++ : nullptr;
    const T* tracker = data_.tracker_is_static ? *next++ : nuisance;
    const T* shape = data_.bodies[body_].is_centroid ? *next++ : nullptr;

    Vector3 p = data_.bodies[body_].is_centroid
                    ? Vector3(data_.bodies[body_].ByParameters(reading_.marker).cast<T>() *
                              Eigen::Map<const Vector3>(shape))
                    : Vector3(data_.bodies[body_].p_in_body.col(reading_.marker).cast<T>());
    if (body_ == 1) {
      Pose<T> base_from_platform = pose_.base_from_platform.Cast<T>();
      if (HasRobotDraw()) {
        const T* draw = data_.tracker_is_static ? nuisance : nuisance + Pose3d::kNumParameters;
        base_from_platform =
            Plus(base_from_platform,
                 Vector6(pose_.robot_root.cast<T>() * Eigen::Map<const Vector6>(draw)));
      }
      p = Pose<T>::FromParameters(base) *
          (base_from_platform * (Pose<T>::FromParameters(tool) * p));
    }
    Eigen::Map<Vector3>{residual} = weight_.cast<T>().cwiseProduct(
        reading_.p_in_tracker.cast<T>() - Pose<T>::FromParameters(tracker) * p);
    return true;
  }

 private:
  const MarkerData& data_;
  const MarkerPose& pose_;
  const int body_;
  const MarkerMean& reading_;
  const Eigen::Vector3d weight_;
};

// The prior of the robot's draw: itself. Its block holds it after `skip` other parameters.
class RobotDrawResidual {
 public:
  explicit RobotDrawResidual(int skip) : skip_(skip) {}

  template <typename T>
  bool operator()(T const* const* parameters, T* residual) const {
    std::copy_n(parameters[0] + skip_, 6, residual);
    return true;
  }

 private:
  const int skip_;
};

}  // namespace hexcal
