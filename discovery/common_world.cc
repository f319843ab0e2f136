// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/common_world.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "geometry/align_points.h"
#include "model/tracker_reading.h"

namespace hexcal {
namespace {

constexpr double kStep = 1e-2;  // of a plausible size

// tracker_from_world from the means of all base readings, rid of these effects.
Pose3d SeeWorld(const GapData& data, const std::vector<Effect>& effects) {
  const Measurement& measurement = *data.dataset->measurement;
  const MarkerBody& body = measurement.bodies[0];
  const auto markers = static_cast<Eigen::Index>(body.markers.size());
  std::vector<Corrections<double>> corrections;
  for (const Visit& visit : data.visits) corrections.push_back(CorrectionsOf(effects, visit));
  Eigen::Matrix3Xd p_in_tracker = Eigen::Matrix3Xd::Zero(3, markers), p_in_body = p_in_tracker;
  Eigen::VectorXd count = Eigen::VectorXd::Zero(markers);
  for (const MarkerReading& reading : measurement.readings) {
    if (reading.body != BodyId::kBase) continue;
    const Corrections<double>& here = corrections[reading.pose];
    p_in_tracker.col(reading.marker) += PointOfReading(here, reading.p_in_tracker);
    p_in_body.col(reading.marker) += body.p_in_body.col(reading.marker);
    if (here.markers[0].cols() > reading.marker)
      p_in_body.col(reading.marker) += here.markers[0].col(reading.marker);
    count[reading.marker] += 1.0;
  }
  const Eigen::Vector3d sigma = measurement.marker_sigma.value_or(Eigen::Vector3d::Ones());
  Eigen::Matrix3Xd deviation(3, markers);
  Eigen::Index seen = 0;
  for (Eigen::Index m = 0; m < markers; ++m) {
    if (count[m] == 0.0) continue;
    p_in_tracker.col(seen) = p_in_tracker.col(m) / count[m];
    p_in_body.col(seen) = p_in_body.col(m) / count[m];
    deviation.col(seen++) = sigma / std::sqrt(count[m]);
  }
  return AlignPointsWeighted(
             p_in_tracker.leftCols(seen), p_in_body.leftCols(seen), deviation.leftCols(seen))
      .a_from_b;
}

// Right twist of world_from_base that one unit of a free parameter makes.
Vector6d TwistBy(
    const GapData& data, const FormLibrary& library, std::size_t form, int k, const Refit& refit) {
  const FormDefinition& definition = library.forms[form];
  const double h = kStep * definition.scale[k];
  std::array<Pose3d, 2> moved;
  for (const int side : {0, 1}) {
    Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(definition.size());
    coefficients[k] = side == 0 ? -h : h;
    std::vector<Effect> effects = refit.effects;
    effects[form] = EffectOf(definition, coefficients);
    moved[side] = SeeWorld(data, effects).Inverse() * data.tool_poses.tracker_from_world.value() *
                  refit.mounts.world_from_base;
  }
  return Minus(moved[1], moved[0]) / (2.0 * h);
}

bool IsCommon(const GapData& data) {
  const Measurement& measurement = *data.dataset->measurement;
  return measurement.kind == Measurement::Kind::kMarkers && data.dataset->tracker.is_static &&
         data.tool_poses.tracker_from_world && !measurement.bodies[0].is_centroid;
}

}  // namespace

void CorrectCommonWorld(const GapData& data, const FormLibrary& library, Refit* refit) {
  if (!IsCommon(data) || refit->effects.empty()) return;
  LinearProblem& linear = refit->problem.linear;
  auto columns = std::make_shared<Eigen::MatrixXd>(*linear.columns);
  Eigen::MatrixXd carry =
      Eigen::MatrixXd::Identity(refit->covariance.rows(), refit->covariance.cols());
  Eigen::Index at = 12;
  for (std::size_t f = 0; f < library.forms.size(); ++f)
    for (int k = 0; k < library.forms[f].size(); ++k, ++at) {
      const Vector6d twist = TwistBy(data, library, f, k, *refit);
      carry.block<6, 1>(0, at) = twist;
      columns->col(linear.forms[f].first + k) -= linear.nuisance.leftCols<6>() * twist;
    }
  refit->covariance = carry * refit->covariance * carry.transpose();
  linear.columns = columns;
  const Pose3d right_from_taken =
      SeeWorld(data, refit->effects).Inverse() * *data.tool_poses.tracker_from_world;
  refit->mounts.world_from_base = right_from_taken * refit->mounts.world_from_base;
  for (SeenPose& seen : refit->problem.seen)
    seen.world_from_tool = right_from_taken * seen.world_from_tool;
  for (Pose3d& predicted : refit->problem.predicted) predicted = right_from_taken * predicted;
}

}  // namespace hexcal
