// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

constexpr int kMaxRounds = 50;
constexpr double kSettled = 1e-7;  // relative change of a variance
// No tracker errs so much that this tilt could be its noise, rad.
constexpr double kBeyondNoise = 0.1;
constexpr double kRounding = 1e-13;  // of lengths: no noise is less
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Residuals of one variance: along the tip's direction (position noise alone), or across it.
struct Component {
  Eigen::Matrix3d part = Eigen::Matrix3d::Identity();  // projector, frame T
  double variance = 0.0;                               // m^2; of a scale: 1
  double squares = 0.0;
  double redundancy = 0.0;

  double Estimate() const { return squares / redundancy; }
};

class Solver {
 public:
  Solver(const PivotPoses& poses, const std::vector<bool>& used, const PivotOptions& options)
      : poses_(poses), used_(used), options_(options) {
    std::vector<PivotPose> fitted;
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) continue;
      fitted.push_back(poses.items[i]);
      indices_.push_back(i);
    }
    solution_.tilts = FindTilts(fitted);
    for (const PivotPose& pose : poses.items) covariances_.push_back(pose.covariance);
  }

  PivotSolution Run() {
    FindLost(poses_.noise == PivotNoise::kKnown);
    if (poses_.noise == PivotNoise::kKnown) {
      Fit(Start());
    } else {
      // The likelihood cannot tell a long tip seen with little noise from a short one seen with
      // much where the tilt is noise; least squares find the short one.
      BoundNoise(Start());
      FindLost(true);
      EstimateNoise();
      if (FindLost(true)) EstimateNoise();
    }
    AccountForNoise();
    for (int k = 0; k < 3; ++k)
      solution_.noise_tilts[k] = NoiseTilt(solution_.tilts.directions.col(k));
    solution_.is_lost = is_lost_;
    return std::move(solution_);
  }

 private:
  // How far the noise tilts the direction, RMS, rad.
  double NoiseTilt(const Eigen::Vector3d& direction) const {
    double sum = 0.0;
    for (const std::size_t i : indices_) {
      const Eigen::Matrix3d c = covariances_[i].bottomRightCorner<3, 3>();
      sum += c.trace() - direction.dot(c * direction);
    }
    return std::sqrt(sum / static_cast<double>(indices_.size()));
  }

  // Whether more are lost than before.
  bool FindLost(bool noise_is_known) {
    bool more = false;
    for (int k = 0; k < 3; ++k) {
      const double tilt = solution_.tilts.rms[k];
      double noise = noise_is_known ? NoiseTilt(solution_.tilts.directions.col(k)) : 0.0;
      if (poses_.noise != PivotNoise::kKnown && tilt > kBeyondNoise) noise = 0.0;
      const bool lost =
          !(tilt > std::max(options_.least_tilt, options_.least_tilt_to_noise * noise));
      more = more || (lost && !is_lost_[k]);
      is_lost_[k] = is_lost_[k] || lost;
    }
    return more;
  }

  TipAndPivot Start() const {
    return SolvePivotAlgebraically(poses_.items, indices_, ComplementOf(solution_.tilts, is_lost_));
  }

  void Fit(const TipAndPivot& start) {
    solution_.fit =
        FitPivot(poses_.items, covariances_, used_, ComplementOf(solution_.tilts, is_lost_), start);
  }

  // As much as could be in the rotations by what x leaves over, and the least that rounding leaves.
  void BoundNoise(const TipAndPivot& x) {
    const Matrix36d by_pose = PivotPoseJacobian(x);
    double length = x.tip_in_tool.norm(), squares = 0.0;
    const bool has_shape = poses_.noise == PivotNoise::kUpToScale;
    for (const std::size_t i : indices_) {
      const Eigen::Vector3d error = PivotError(poses_.items[i].world_from_tool, x);
      const Matrix6d& covariance = covariances_[i];
      squares += has_shape
                     ? error.dot((by_pose * covariance * by_pose.transpose()).inverse() * error)
                     : error.squaredNorm();
      length = std::max(length, poses_.items[i].world_from_tool.translation.norm());
    }
    floor_ = std::pow(kRounding * length, 2);
    const double variance =
        squares / std::max(1.0, 3.0 * static_cast<double>(indices_.size()) - 6.0);
    if (has_shape)
      Scale(variance);
    else
      SetLevels(std::max(floor_, variance), std::max(floor_, variance), x.tip_in_tool);
  }

  // across: the part of it that turns add.
  void SetLevels(double along, double turns, const Eigen::Vector3d& tip) {
    const double squared = tip.squaredNorm();
    solution_.position_noise = std::sqrt(along);
    solution_.orientation_noise = squared > 0.0 ? std::sqrt(turns / squared) : 0.0;
    Vector6d variances;
    variances << Eigen::Vector3d::Constant(along),
        Eigen::Vector3d::Constant(squared > 0.0 ? turns / squared : 0.0);
    covariances_.assign(covariances_.size(), variances.asDiagonal());
  }

  // One for a scale or where there is no tip to turn about, else along the tip and across it.
  std::vector<Component> Components() const {
    std::vector<Component> components(1);
    const Eigen::Vector3d tip = solution_.fit.x.tip_in_tool;
    if (poses_.noise == PivotNoise::kUnknown && tip.norm() > 0.0) {
      const Eigen::Vector3d u = tip.normalized();
      components[0].part = u * u.transpose();
      components.emplace_back();
      components[1].part -= components[0].part;
    }
    return components;
  }

  // Squares and what the fit leaves free of them, by component.
  std::vector<Component> Gather() const {
    std::vector<Component> components = Components();
    for (const std::size_t i : indices_) {
      const PivotFit::Row& row = solution_.fit.rows[i];
      const Eigen::Matrix3d weight = row.noise.inverse();
      for (Component& c : components) {
        // The part commutes with the noise: it is its own, or all of it.
        const Eigen::Matrix3d partial = c.part * weight;
        c.squares += row.error.dot(partial * row.error);
        c.redundancy += (partial * (row.noise - row.prediction)).trace();
        c.variance = (c.part * row.noise).trace() / c.part.trace();
      }
    }
    return components;
  }

  void EstimateNoise() {
    const TipAndPivot start = Start();
    for (int round = 0; round < kMaxRounds; ++round) {
      Fit(start);
      const std::vector<Component> c = Gather();
      const double change = poses_.noise == PivotNoise::kUpToScale ? Rescale(c[0]) : Reassign(c);
      if (change <= kSettled) break;
    }
    Fit(start);
  }

  double Rescale(const Component& c) {
    const double factor = c.redundancy > 0.5 ? c.Estimate() : 1.0;
    Scale(factor);
    return std::abs(factor - 1.0);
  }

  void Scale(double factor) {
    // Of exact data: covariances must stay definite.
    constexpr double kLeastScale = 1e-12;
    const double scale = std::max(kLeastScale, solution_.noise_scale * std::sqrt(factor));
    for (Matrix6d& covariance : covariances_)
      covariance *= std::pow(scale / solution_.noise_scale, 2);
    solution_.noise_scale = scale;
  }

  double Reassign(const std::vector<Component>& c) {
    double along = c[0].variance * c[0].Estimate();
    double across = c.size() > 1 ? c[1].variance * c[1].Estimate() : along;
    are_pooled_ = !(across > along) || !(c[0].redundancy > 0.5);
    if (are_pooled_) {
      double squares = 0.0, redundancy = 0.0;
      for (const Component& each : c) {
        squares += each.variance * each.squares;
        redundancy += each.redundancy;
      }
      along = across = squares / redundancy;
    }
    along = std::max(along, floor_), across = std::max(across, floor_);
    const double before = c.back().variance;
    const double change =
        std::max(std::abs(along / c[0].variance - 1.0), std::abs(across / before - 1.0));
    SetLevels(along, across - along, solution_.fit.x.tip_in_tool);
    return along == floor_ ? 0.0 : change;
  }

  // What it costs not to know the noise: the variance of a parameter is a sum over the components
  // (Welch and Satterthwaite), and weights that err add to it (Kenward and Roger).
  void AccountForNoise() {
    Matrix6d& covariance = solution_.covariance;
    covariance = solution_.fit.covariance;
    solution_.degrees_of_freedom.setConstant(kInfinity);
    solution_.tip_degrees_of_freedom = kInfinity;
    if (poses_.noise == PivotNoise::kKnown) return;
    const auto all = static_cast<double>(solution_.fit.degrees_of_freedom);
    solution_.degrees_of_freedom.setConstant(all);
    solution_.tip_degrees_of_freedom = all;
    const std::vector<Component> components = Gather();
    if (components.size() < 2 || are_pooled_) return;
    Vector6d per_freedom = Vector6d::Zero();
    double tip_per_freedom = 0.0;
    Matrix6d widening = Matrix6d::Zero();
    for (const Component& c : components) {
      const Matrix6d information = InformationOf(c);
      const Matrix6d share = covariance * information * covariance;
      per_freedom += share.diagonal().cwiseAbs2() / c.redundancy;
      tip_per_freedom += std::pow(share.topLeftCorner<3, 3>().trace(), 2) / c.redundancy;
      widening += 2.0 / c.redundancy * (share - share * information * covariance);
    }
    for (int k = 0; k < 6; ++k)
      if (per_freedom[k] > 0.0)
        solution_.degrees_of_freedom[k] = std::pow(covariance(k, k), 2) / per_freedom[k];
    if (tip_per_freedom > 0.0)
      solution_.tip_degrees_of_freedom =
          std::pow(covariance.topLeftCorner<3, 3>().trace(), 2) / tip_per_freedom;
    covariance += widening + widening.transpose();
  }

  // About (tip, pivot).
  Matrix6d InformationOf(const Component& c) const {
    Matrix6d information = Matrix6d::Zero();
    for (const std::size_t i : indices_) {
      const PivotFit::Row& row = solution_.fit.rows[i];
      information += row.jacobian.transpose() * c.part * row.noise.inverse() * row.jacobian;
    }
    return information;
  }

  const PivotPoses& poses_;
  const std::vector<bool>& used_;
  const PivotOptions& options_;
  std::vector<std::size_t> indices_;
  std::vector<Matrix6d> covariances_;
  std::array<bool, 3> is_lost_ = {};  // by direction of tilts
  bool are_pooled_ = false;
  double floor_ = 0.0;  // of a variance, m^2
  PivotSolution solution_;
};

}  // namespace

Eigen::Matrix3Xd ComplementOf(const Tilts& tilts, const std::array<bool, 3>& is_lost) {
  Eigen::Matrix3Xd basis(3, std::count(is_lost.begin(), is_lost.end(), false));
  for (Eigen::Index k = 0, column = 0; k < 3; ++k)
    if (!is_lost[k]) basis.col(column++) = tilts.directions.col(k);
  return basis;
}

PivotSolution SolvePivot(const PivotPoses& poses,
                         const std::vector<bool>& used,
                         const PivotOptions& options) {
  return Solver(poses, used, options).Run();
}

}  // namespace hexcal
