// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/reading_rows.h"

#include <cmath>

#include "residuals/marker_pose.h"

namespace hexcal {
namespace {

using RowsByTwist = Eigen::Matrix<double, 3, 6>;

// The whitened prediction of a marker at p of a body by the twist of that body, on its right.
RowsByTwist ByTwist(const Eigen::Matrix3d& whitened_rotation, const Eigen::Vector3d& p) {
  RowsByTwist rows;
  rows.leftCols<3>() = whitened_rotation;
  for (int k = 0; k < 3; ++k) rows.row(k).tail<3>() = p.cross(whitened_rotation.row(k).transpose());
  return rows;
}

class PoseLinearised {
 public:
  PoseLinearised(const MarkerData& data,
                 const MarkerUnknowns& unknowns,
                 const Eigen::Vector3d& sigma,
                 const MarkerPose& pose,
                 bool is_cut)
      : data_(data),
        layout_(data),
        unknowns_(unknowns),
        sigma_(sigma),
        pose_(pose),
        likelihood_(data, sigma, unknowns, pose),
        is_cut_(is_cut && likelihood_.HasTool()) {
    nuisance_ = likelihood_.Eliminate(&terms_);
    trackers_ = data.tracker_is_static ? 0 : 6;
    cuts_ = is_cut_ ? 6 : 0;
    rows_.draws = data.has_robot_noise && likelihood_.HasTool() && !is_cut_ ? 6 : 0;
  }

  ReadingRows Run() {
    const int count = pose_.end - pose_.first_base;
    rows_.first = pose_.first_base;
    rows_.residual.resize(3 * count);
    rows_.globals.setZero(3 * count, layout_.size);
    rows_.own.setZero(3 * count, trackers_ + cuts_ + rows_.draws);
    rows_.draw = nuisance_.robot_draw.head(rows_.draws);
    const Pose3d tracker_from_tool = TrackerFromTool();
    likelihood_.ForEachMisfit(nuisance_, [&](int i, const Eigen::Vector3d& misfit) {
      const int body = i < pose_.first_tool ? 0 : 1;
      Add(i - pose_.first_base,
          body,
          body == 0 ? nuisance_.tracker_from_world : tracker_from_tool,
          data_.readings[i],
          misfit);
    });
    return std::move(rows_);
  }

 private:
  Pose3d TrackerFromTool() const {
    Pose3d base_from_platform = pose_.base_from_platform;
    if (data_.has_robot_noise)
      base_from_platform =
          Plus(base_from_platform, Vector6d(pose_.robot_root * nuisance_.robot_draw));
    return nuisance_.tracker_from_world * unknowns_.world_from_base * base_from_platform *
           unknowns_.platform_from_tool;
  }

  void Add(int at,
           int body,
           const Pose3d& tracker_from_body,
           const MarkerMean& reading,
           const Eigen::Vector3d& misfit) {
    const Eigen::Vector3d sigma = sigma_ / std::sqrt(static_cast<double>(reading.frames));
    const Eigen::Matrix3d turned =
        sigma.cwiseInverse().asDiagonal() * tracker_from_body.rotation.toRotationMatrix();
    const RowsByTwist by_twist = ByTwist(turned, unknowns_.p_in_body[body].col(reading.marker));
    rows_.sigma.push_back(sigma);
    rows_.residual.segment<3>(3 * at) = misfit.cwiseQuotient(sigma);
    auto globals = rows_.globals.middleRows<3>(3 * at);
    auto own = rows_.own.middleRows<3>(3 * at);
    if (layout_.shape[body] >= 0)
      globals.middleCols<3>(layout_.shape[body]) =
          turned * data_.bodies[body].ByParameters(reading.marker);
    // How the body's twist follows that of the world, and for the tool what is between.
    const RowsByTwist by_world = body == 0 ? by_twist : RowsByTwist(by_twist * terms_.by_world);
    if (trackers_ > 0)
      own.leftCols<6>() = by_world;
    else
      globals.middleCols<6>(layout_.tracker) = by_world;
    if (body == 0) return;
    globals.leftCols<6>() = by_twist * terms_.by_base;
    globals.middleCols<6>(6) = by_twist;
    if (cuts_ > 0) own.middleCols<6>(trackers_) = by_twist;
    if (rows_.draws > 0) own.rightCols<6>() = by_twist * terms_.by_robot;
  }

  const MarkerData& data_;
  const MarkerLayout layout_;
  const MarkerUnknowns& unknowns_;
  const Eigen::Vector3d& sigma_;
  const MarkerPose& pose_;
  MarkerPoseLikelihood likelihood_;
  bool is_cut_;
  int trackers_ = 0, cuts_ = 0;
  PoseTerms terms_;
  MarkerNuisance nuisance_;
  ReadingRows rows_;
};

}  // namespace

ReadingRows LineariseReadings(const MarkerData& data,
                              const MarkerUnknowns& unknowns,
                              const Eigen::Vector3d& sigma,
                              const MarkerPose& pose,
                              bool is_cut) {
  return PoseLinearised(data, unknowns, sigma, pose, is_cut).Run();
}

}  // namespace hexcal
