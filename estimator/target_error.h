// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimator/estimate.h"
#include "estimator/grown_target.h"

namespace hexcal {

// Where a source of error acts: as a small motion of the platform in the base (right of T_A^B), of
// the tool on the platform (right of T_T^A), of the world in which the target is known (left of
// T_T^W, about the origin of W), as a shift of the point itself, or of
// where the point is on the tool (along the axes of frame T).
enum class SourceSite { kPlatform, kTool, kWorld, kPoint, kPointInTool };

// How the error is spread, for drawing it; its covariance is the same.
enum class Spread1d { kNormal, kUniform };

// An error, other than that of the calibration, that a point of the tool has where it is used.
struct ErrorSource {
  std::string name;
  SourceSite site = SourceSite::kPlatform;
  double position = 0.0;     // 1-sigma of each coordinate, m
  double orientation = 0.0;  // 1-sigma about each axis, rad; none at kPoint and kPointInTool
  Spread1d spread = Spread1d::kNormal;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
  // kPointInTool, normal: in place of position, m^2.
  std::optional<Eigen::Matrix3d> covariance_in_tool = std::nullopt;
};

// The error of a point where the robot reports a pose: predicted minus true, axes of frame W, m^2.
struct TargetCovariance {
  Eigen::Vector3d p_in_world;
  Eigen::Matrix3d calibration;  // J covariance J'
  // Parts of it: what would go were the effects of the model known; what rests on their priors.
  Eigen::Matrix3d of_effects = Eigen::Matrix3d::Zero(), by_priors = Eigen::Matrix3d::Zero();
  std::vector<Eigen::Matrix3d> shares;  // of the sources, in their order
  // RMS length that 1 m and 1 rad of each coordinate of a source make, m/m and m/rad.
  std::vector<Eigen::Vector2d> sensitivities;
  Eigen::Matrix3d total;
  double degrees_of_freedom = 0.0;  // with which total is known (Welch-Satterthwaite, by traces)

  double Rms() const;                         // root mean square length, m
  double Quantile(double probability) const;  // of the length, m
};

// Target registration error of points of the tool: how far predictions by base and tool are from
// where the points really are. First order in the errors.
class TargetError {
 public:
  // grown: the machine whose effects the estimate was made with; null: base and tool alone.
  TargetError(const Estimate& estimate,
              std::vector<ErrorSource> sources,
              std::shared_ptr<const GrownTarget> grown = nullptr);

  // row: of the dataset's, where the place is one of its poses; only effects ask for it. All NaN
  // where effects put the legs out of reach.
  TargetCovariance At(const Pose3d& base_from_platform,
                      const Eigen::Vector3d& p_in_tool,
                      int row = GrownTarget::kNoRow) const;

  // What At makes the calibration's share of: the point's derivative by the calibration's numbers
  // (the 12, then the free ones of the effects), axes of frame W, and their covariance.
  struct Carried {
    Eigen::Matrix<double, 3, Eigen::Dynamic> by_parameters;
    Eigen::MatrixXd covariance;
  };
  // Nothing where effects put the legs out of reach.
  std::optional<Carried> CarriedTo(const Pose3d& base_from_platform,
                                   const Eigen::Vector3d& p_in_tool) const;

  const std::vector<ErrorSource>& sources() const { return sources_; }

 private:
  // The chain there, and the calibration's share of the target's covariance.
  GrownTarget::Chain Calibration(const Pose3d& base_from_platform,
                                 const Eigen::Vector3d& p_in_tool,
                                 int row,
                                 TargetCovariance* target,
                                 double* degrees_of_freedom) const;

  BaseAndTool mounts_;
  Matrix12d covariance_;  // of the 12, as CoverageCovariance
  double degrees_of_freedom_;
  std::vector<ErrorSource> sources_;
  std::shared_ptr<const GrownTarget> grown_;
};

// The covariance that makes the estimate's 95 % intervals those of Student's t: wider than
// estimate.covariance where few poses told the noise (Kenward and Roger).
Matrix12d CoverageCovariance(const Estimate& estimate);

// Of the parameters that are determined, the fewest with which one's standard deviation is known.
double LeastDegreesOfFreedom(const Estimate& estimate);

// d(p_in_a) / d(right perturbation of a_from_b), 3 x 6, axes of a: R [1, -[p]x].
Eigen::Matrix<double, 3, 6> PointJacobian(const Pose3d& a_from_b, const Eigen::Vector3d& p_in_b);

// d(p_in_world) / d(the 12 parameters), 3 x 12, axes of frame W.
Eigen::Matrix<double, 3, 12> TargetJacobian(const BaseAndTool& mounts,
                                            const Pose3d& base_from_platform,
                                            const Eigen::Vector3d& p_in_tool);

}  // namespace hexcal
