// SPDX-License-Identifier: BSD-3-Clause
#include "report/left_over.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "estimator/target_error.h"
#include "geometry/align_points.h"

namespace hexcal {
namespace {

// One marker's readings in one pose.
struct Mean {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int frames = 0;
};

// What the noise explains of the markers' residuals: each pose's place of the world in the tracker
// was fitted to them (of a static tracker one for all), and the 12 to all of them.
class Expectation {
 public:
  Expectation(const Dataset& dataset, const Observations& observations, const Estimate& estimate)
      : dataset_(dataset),
        observations_(observations),
        estimate_(estimate),
        sigma_(*estimate.noise.marker) {
    for (std::size_t i = 0; i < dataset.robot_poses.rows.size(); ++i)
      row_of_.emplace(dataset.robot_poses.rows[i].label, static_cast<int>(i));
    for (const MarkerReading& r : dataset.measurement->readings) {
      Mean& mean = means_[{r.pose, LabelOf(r)}];
      mean.sum += r.p_in_tracker;
      ++mean.frames;
    }
    for (int b = 0; b < 2; ++b) {
      const MarkerBody& body = dataset.measurement->bodies[b];
      for (std::size_t k = 0; k < body.markers.size(); ++k)
        place_of_[(b == 0 ? "base/" : "tool/") + body.markers[k]] = {
            b, body.p_in_body.col(static_cast<Eigen::Index>(k))};
    }
  }

  // Sum of the variances of the residual's three coordinates, by label; m^2.
  std::map<std::string, double> Run() {
    if (dataset_.tracker.is_static) {
      for (std::size_t i = 0; i < estimate_.poses.size(); ++i) Gather(i);
      Flush();
    } else {
      for (std::size_t i = 0; i < estimate_.poses.size(); ++i) Gather(i), Flush();
    }
    // Robot poses that err take a part, too.
    const double part =
        whitened_ > 0.0 ? std::clamp(estimate_.degrees_of_freedom / whitened_, 0.0, 1.0) : 1.0;
    for (auto& [label, variance] : variance_of_) variance *= part;
    return variance_of_;
  }

 private:
  struct Place {
    int body = 0;
    Eigen::Vector3d p_in_body;
  };
  struct Seen {
    std::string label;
    Eigen::Vector3d p_in_tracker, p_in_world, sigma;
    Eigen::Matrix<double, 3, 12> by_mounts;  // d(p_in_world) / d(the 12 parameters)
  };

  std::string LabelOf(const MarkerReading& r) const {
    const auto body = static_cast<std::size_t>(r.body);
    return (body == 0 ? "base/" : "tool/") +
           dataset_.measurement->bodies[body].markers[static_cast<std::size_t>(r.marker)];
  }

  void Gather(std::size_t i) {
    const PoseResult& pose = estimate_.poses[i];
    if (!(pose.weight > 0.0)) return;
    const Pose3d world_from_tool = estimate_.mounts.world_from_base *
                                   observations_.items[i].base_from_platform *
                                   estimate_.mounts.platform_from_tool;
    for (const MarkerMisfit& misfit : pose.markers) {
      const auto mean = means_.find({row_of_.at(pose.label), misfit.marker});
      const auto place = place_of_.find(misfit.marker);
      if (mean == means_.end() || place == place_of_.end()) continue;
      const Eigen::Vector3d& p = place->second.p_in_body;
      const double frames = mean->second.frames;
      Seen seen{misfit.marker, mean->second.sum / frames, p, sigma_ / std::sqrt(frames), {}};
      seen.by_mounts.setZero();
      if (place->second.body == 1) {
        seen.p_in_world = world_from_tool * p;
        seen.by_mounts =
            TargetJacobian(estimate_.mounts, observations_.items[i].base_from_platform, p);
      }
      seen_.push_back(seen);
    }
  }

  // Of all that were gathered, which one place of the world was fitted to.
  void Flush() {
    const auto n = static_cast<Eigen::Index>(seen_.size());
    if (n >= 3) {
      Eigen::Matrix3Xd p_in_tracker(3, n), p_in_world(3, n), sigma(3, n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const Seen& seen = seen_[static_cast<std::size_t>(k)];
        p_in_tracker.col(k) = seen.p_in_tracker;
        p_in_world.col(k) = seen.p_in_world;
        sigma.col(k) = seen.sigma;
      }
      AddVariances(AlignPointsWeighted(p_in_tracker, p_in_world, sigma));
    }
    seen_.clear();
  }

  // The readings' own less what the fit of the place and that of the 12 take.
  void AddVariances(const Alignment& fit) {
    const Eigen::Matrix3d turn = fit.a_from_b.rotation.toRotationMatrix();
    Eigen::Matrix<double, 6, 12> place_by_mounts = Eigen::Matrix<double, 6, 12>::Zero();
    for (const Seen& seen : seen_) {
      const Eigen::Vector3d weight = seen.sigma.cwiseAbs2().cwiseInverse();
      place_by_mounts += fit.covariance * PointJacobian(fit.a_from_b, seen.p_in_world).transpose() *
                         weight.asDiagonal() * turn * seen.by_mounts;
    }
    for (const Seen& seen : seen_) {
      const Eigen::Matrix<double, 3, 6> by_place = PointJacobian(fit.a_from_b, seen.p_in_world);
      const Eigen::Matrix<double, 3, 12> by_mounts =
          turn * seen.by_mounts - by_place * place_by_mounts;
      const Eigen::Vector3d taken =
          (by_place * fit.covariance * by_place.transpose() +
           by_mounts * estimate_.covariance_unscaled * by_mounts.transpose())
              .diagonal();
      const Eigen::Vector3d variance = (seen.sigma.cwiseAbs2() - taken).cwiseMax(0.0);
      variance_of_[seen.label] += variance.sum();
      whitened_ += variance.cwiseQuotient(seen.sigma.cwiseAbs2()).sum();
    }
  }

  const Dataset& dataset_;
  const Observations& observations_;
  const Estimate& estimate_;
  const Eigen::Vector3d sigma_;  // of a reading, m
  std::unordered_map<std::string, int> row_of_;
  std::map<std::pair<int, std::string>, Mean> means_;  // by row and label
  std::map<std::string, Place> place_of_;
  std::vector<Seen> seen_;
  std::map<std::string, double> variance_of_;
  double whitened_ = 0.0;  // of all variances, in those of the readings
};

bool IsByMarkers(const Dataset& dataset, const Estimate& estimate) {
  if (!estimate.noise.marker || !(estimate.noise.marker->minCoeff() > 0.0)) return false;
  if (dataset.measurement->kind != Measurement::Kind::kMarkers) return false;
  for (const MarkerBody& body : dataset.measurement->bodies)
    if (body.is_centroid) return false;  // which has no shape that a marker could be off
  return std::any_of(estimate.poses.begin(), estimate.poses.end(), [](const PoseResult& pose) {
    return !pose.markers.empty();
  });
}

}  // namespace

LeftOver MakeLeftOver(const Dataset& dataset,
                      const Observations& observations,
                      const Estimate& estimate) {
  LeftOver left;
  left.poses = ResidualsOf(dataset, observations, estimate);
  if (!IsByMarkers(dataset, estimate)) return left;
  const std::map<std::string, double> expected = Expectation(dataset, observations, estimate).Run();
  std::map<std::string, MarkerLeftOver> markers;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i)
    for (const MarkerMisfit& misfit : estimate.poses[i].markers) {
      MarkerLeftOver& marker = markers[misfit.marker];
      marker.label = misfit.marker;
      marker.residuals.push_back(misfit.residual);
      marker.pose_of_residual.push_back(i);
      marker.used.push_back(estimate.poses[i].weight > 0.0);
      if (!(estimate.poses[i].weight > 0.0)) continue;
      ++marker.poses;
      marker.rms += misfit.residual.squaredNorm();
    }
  for (auto& [label, marker] : markers) {
    const double coordinates = 3.0 * std::max(marker.poses, 1);
    marker.rms = std::sqrt(marker.rms / coordinates);
    const auto found = expected.find(label);
    marker.expected = found == expected.end() ? 0.0 : std::sqrt(found->second / coordinates);
    left.markers.push_back(std::move(marker));
  }
  return left;
}

}  // namespace hexcal
