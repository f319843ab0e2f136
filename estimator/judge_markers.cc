// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/judge_markers.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "estimator/judge_common.h"
#include "estimator/rms.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

// With so much more left over than repeated frames scatter, something besides noise is in it.
constexpr double kDoubtfulScale = 2.0;

std::vector<std::vector<MarkerMisfit>> ByItem(const MarkerObservations& markers,
                                              std::size_t items,
                                              const MarkerFit& fit) {
  std::vector<std::vector<MarkerMisfit>> lists(items);
  for (std::size_t i = 0; i < markers.data.poses.size(); ++i) {
    if (markers.item_of_pose[i] < 0) continue;
    const MarkerPose& pose = markers.data.poses[i];
    for (int r = pose.first_base; r < pose.end; ++r) {
      const int body = r < pose.first_tool ? 0 : 1;
      lists[markers.item_of_pose[i]].push_back(
          {markers.labels[body][markers.data.readings[r].marker], fit.misfits[r]});
    }
  }
  return lists;
}

class MarkerJudgement {
 public:
  MarkerJudgement(const Observations& observations,
                  const MarkerObservations& markers,
                  const MarkerSolution& solution,
                  Estimate* estimate)
      : observations_(observations),
        markers_(markers),
        solution_(solution),
        estimate_(*estimate),
        batch_(markers.data, solution.sigma),
        equations_(Evaluate(batch_, solution.blocks)) {
    fit_ = FitOf(batch_, solution.blocks, equations_);
  }

  void Run() {
    SetResiduals();
    SetNoise();
    SetCovariance();
    SetIntervals();
    AddWarnings();
  }

 private:
  void SetResiduals() {
    RmsError rms;
    for (const Observation& o : observations_.items) {
      const Vector6d e =
          PoseError(estimate_.mounts, o.base_from_platform, MeasuredWorldFromTool(o));
      estimate_.poses.push_back({o.label, 1.0, e});
      rms.Add(e);
    }
    estimate_.rmspe = rms.Position();
    estimate_.rmsoe = rms.Orientation();
    auto misfits = ByItem(markers_, estimate_.poses.size(), fit_);
    for (std::size_t i = 0; i < misfits.size(); ++i)
      estimate_.poses[i].markers = std::move(misfits[i]);
    if (markers_.data.tracker_is_static) estimate_.tracker_from_world = fit_.tracker_from_world[0];
    estimate_.chi_square = fit_.squared_readings + fit_.squared_draws;
  }

  // Of a static tracker, whose pose the fit has moved.
  Pose3d MeasuredWorldFromTool(const Observation& o) const {
    if (!observations_.tracker_from_world) return o.world_from_tool;
    return fit_.tracker_from_world[0].Inverse() * *observations_.tracker_from_world *
           o.world_from_tool;
  }

  void SetNoise() {
    const Vector6d robot = RobotVariance(observations_, estimate_.mounts);
    const Vector6d variance = fit_.tool_variance + robot;
    estimate_.noise.position = std::sqrt(variance.head<3>().mean());
    estimate_.noise.orientation = std::sqrt(variance.tail<3>().mean());
    estimate_.noise.estimated = solution_.sigma_estimated;
    estimate_.noise.marker = solution_.sigma;
    estimate_.noise.assumed = SideOfNoise(fit_.tool_variance, robot);
  }

  // What the normal matrix tells of the 12, the others eliminated, as the factor of its rows.
  Matrix12d RFactor() const {
    const Eigen::Index others = equations_.normal.rows() - 12;
    Eigen::MatrixXd reduced = equations_.normal.topLeftCorner<12, 12>();
    if (others > 0) {
      const Eigen::MatrixXd cross = equations_.normal.bottomLeftCorner(others, 12);
      reduced -= cross.transpose() *
                 equations_.normal.bottomRightCorner(others, others).ldlt().solve(cross);
    }
    const Eigen::VectorXd norms = reduced.diagonal().cwiseMax(0.0).cwiseSqrt();
    const Eigen::VectorXd scale = norms.unaryExpr([](double n) { return n > 0.0 ? 1.0 / n : 0.0; });
    const Eigenvalues e = DecomposeSymmetric(scale.asDiagonal() * reduced * scale.asDiagonal());
    const Eigen::VectorXd roots = e.values.cwiseMax(0.0).cwiseSqrt();
    return roots.asDiagonal() * e.vectors.transpose() * norms.asDiagonal();
  }

  void SetCovariance() {
    const int freedom = markers_.NumResiduals() - markers_.NumParameters();
    CovarianceOptions limits = LimitsOf(observations_, estimate_.mounts);
    if (!solution_.sigma_estimated)
      limits.noise_scale = std::max(1.0, std::sqrt(estimate_.chi_square / freedom));
    const ParameterCovariance result = ComputeCovariance(RFactor(), limits);
    estimate_.observability = result.observability;
    estimate_.degrees_of_freedom = freedom + result.observability.null_directions;
    estimate_.noise_scale = std::sqrt(estimate_.chi_square / estimate_.degrees_of_freedom);
    estimate_.covariance_unscaled = result.covariance;
    const double scale = solution_.sigma_estimated ? std::pow(estimate_.noise_scale, 2) : 1.0;
    estimate_.covariance = scale * result.covariance;
    estimate_.intervals =
        solution_.sigma_estimated
            ? IntervalsOfScaledNoise(estimate_.covariance, estimate_.degrees_of_freedom)
            : IntervalsOfKnownNoise(estimate_.covariance);
  }

  void SetIntervals() {
    estimate_.intervals =
        solution_.sigma_estimated
            ? IntervalsOfScaledNoise(estimate_.covariance, estimate_.degrees_of_freedom)
            : IntervalsOfKnownNoise(estimate_.covariance);
  }

  void AddWarnings() {
    auto& warnings = estimate_.warnings;
    if (!estimate_.converged) warnings.push_back("no convergence: " + estimate_.message);
    for (const std::string& direction : estimate_.observability.weak_directions)
      warnings.push_back("the data do not determine " + direction);
    if (solution_.over_repeats && *solution_.over_repeats > kDoubtfulScale)
      warnings.push_back(
          fmt::format("the readings are {:.3g} times farther from the fit than repeated frames are "
                      "from each other: the model misses something",
                      *solution_.over_repeats));
    if (!solution_.sigma_estimated || observations_.has_robot_noise)
      AddNoiseDoubts(estimate_.noise_scale, estimate_.degrees_of_freedom, &warnings);
  }

  const Observations& observations_;
  const MarkerObservations& markers_;
  const MarkerSolution& solution_;
  Estimate& estimate_;
  const MarkerBatch batch_;
  const NormalEquations equations_;
  MarkerFit fit_;
};

}  // namespace

std::vector<std::vector<MarkerMisfit>> MisfitsByItem(const MarkerObservations& markers,
                                                     std::size_t items,
                                                     const MarkerSolution& solution) {
  const MarkerBatch batch(markers.data, solution.sigma);
  const NormalEquations equations = Evaluate(batch, solution.blocks);
  return ByItem(markers, items, FitOf(batch, solution.blocks, equations));
}

void JudgeMarkers(const Observations& observations,
                  const MarkerObservations& markers,
                  const MarkerSolution& solution,
                  Estimate* estimate) {
  MarkerJudgement(observations, markers, solution, estimate).Run();
}

}  // namespace hexcal
