// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/marker_data.h"

namespace hexcal {
namespace {

Eigen::VectorXd ParametersOf(const Pose3d& pose) {
  Eigen::VectorXd parameters(Pose3d::kNumParameters);
  pose.ToParameters(parameters.data());
  return parameters;
}

}  // namespace

Eigen::Vector3d MarkerShape::Parameters() const {
  const int third = 3 - x_axis[0] - x_axis[1];
  return {
      p_in_body(0, x_axis[1]) - p_in_body(0, x_axis[0]), p_in_body(0, third), p_in_body(1, third)};
}

Eigen::Matrix3d MarkerShape::ByParameters(int marker) const {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  if (marker != x_axis[0] && marker != x_axis[1]) {
    m(0, 1) = m(1, 2) = 1.0;
    return m;
  }
  m(0, 0) = marker == x_axis[1] ? 0.5 : -0.5;
  m(0, 1) = m(1, 2) = -0.5;
  return m;
}

Eigen::Matrix3Xd MarkerShape::FromParameters(const Eigen::Vector3d& parameters) const {
  Eigen::Matrix3Xd p(3, 3);
  for (int marker = 0; marker < 3; ++marker) p.col(marker) = ByParameters(marker) * parameters;
  return p;
}

MarkerLayout::MarkerLayout(const MarkerData& data) {
  if (data.tracker_is_static) {
    tracker = size;
    size += Pose3d::kNumDof;
    block_sizes.push_back(Pose3d::kNumParameters);
  }
  for (int body = 0; body < 2; ++body) {
    if (!data.bodies[body].is_centroid) continue;
    shape[body] = size;
    size += 3;
    block_sizes.push_back(3);
  }
}

MarkerUnknowns MarkerLayout::Unknowns(const MarkerData& data,
                                      double const* const* parameters) const {
  MarkerUnknowns unknowns;
  unknowns.world_from_base = Pose3d::FromParameters(*parameters++);
  unknowns.platform_from_tool = Pose3d::FromParameters(*parameters++);
  if (tracker >= 0) unknowns.tracker_from_world = Pose3d::FromParameters(*parameters++);
  for (int body = 0; body < 2; ++body) {
    const MarkerShape& known = data.bodies[body];
    unknowns.p_in_body[body] =
        known.is_centroid ? known.FromParameters(Eigen::Map<const Eigen::Vector3d>(*parameters++))
                          : known.p_in_body;
  }
  return unknowns;
}

std::vector<Eigen::VectorXd> MarkerLayout::Start(const MarkerData& data,
                                                 const Pose3d& world_from_base,
                                                 const Pose3d& platform_from_tool) const {
  std::vector<Eigen::VectorXd> start = {ParametersOf(world_from_base),
                                        ParametersOf(platform_from_tool)};
  if (tracker >= 0) start.push_back(ParametersOf(data.poses[0].tracker_from_world));
  for (const MarkerShape& body : data.bodies)
    if (body.is_centroid) start.emplace_back(body.Parameters());
  return start;
}

}  // namespace hexcal
