// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/judge.h"

#include <algorithm>
#include <cmath>

#include "estimator/judge_common.h"
#include "estimator/linearized.h"
#include "estimator/normal_matrix.h"
#include "estimator/rms.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

class Judgement {
 public:
  Judgement(const Observations& observations, const Weighting& weighting, Estimate* estimate)
      : observations_(observations), weighting_(weighting), estimate_(*estimate) {}

  void Run() {
    SetResiduals();
    SetCovariance();
    AddWarnings();
  }

 private:
  Matrix6d Covariance(const Observation& o) const {
    return ErrorCovariance(
        o, observations_, estimate_.mounts.platform_from_tool, weighting_.levels);
  }

  void SetResiduals() {
    estimate_.tracker_from_world = observations_.tracker_from_world;
    const double n = static_cast<double>(observations_.items.size());
    RmsError rms;
    Vector6d mean_variance = Vector6d::Zero();
    for (const Observation& o : observations_.items) {
      const Vector6d e = PoseError(estimate_.mounts, o.base_from_platform, o.world_from_tool);
      const Matrix6d c = Covariance(o);
      estimate_.poses.push_back({o.label, 1.0, e});
      estimate_.chi_square += (WhitenerOf(c) * e).squaredNorm();
      rms.Add(e);
      mean_variance += c.diagonal() / n;
    }
    estimate_.rmspe = rms.Position();
    estimate_.rmsoe = rms.Orientation();
    if (weighting_.paper_error) {  // Eq. (42) over the paper's own differences
      estimate_.rmspe = estimate_.iterations.back().rmspe;
      estimate_.rmsoe = estimate_.iterations.back().rmsoe;
    }
    const Vector6d robot = RobotVariance(observations_, estimate_.mounts);
    estimate_.noise = {std::sqrt(mean_variance.head<3>().mean()),
                       std::sqrt(mean_variance.tail<3>().mean()),
                       weighting_.levels_estimated,
                       {},
                       SideOfNoise(mean_variance - robot, robot)};
  }

  void SetCovariance() {
    JacobianFactor factor;
    for (const Observation& o : observations_.items)
      factor.Add(WhitenerOf(Covariance(o)) * Linearise(o, estimate_.mounts).jacobian);
    ParameterCovariance result = ComputeCovariance(factor.R(), Limits());
    estimate_.observability = result.observability;
    if (weighting_.paper_error) result.covariance = PaperCovariance();

    const int parameters = 12 - result.observability.null_directions;
    estimate_.degrees_of_freedom = 6 * static_cast<int>(observations_.items.size()) - parameters;
    estimate_.noise_scale = std::sqrt(estimate_.chi_square / estimate_.degrees_of_freedom);
    // The paper's estimator leaves more than the noise; its covariance knows that already.
    const bool is_scaled = weighting_.levels_estimated && !weighting_.paper_error;
    const double scale = is_scaled ? std::pow(estimate_.noise_scale, 2) : 1.0;
    const Matrix12d common = CommonTrackerCovariance();
    estimate_.covariance_unscaled = result.covariance + common;
    estimate_.covariance = scale * result.covariance + common;
  }

  // The paper's iteration stands still where sum J' S e = 0, with S what its pose difference makes
  // of e: y = (J'SJ)^-1 J'S e, and its covariance follows from that of e.
  Matrix12d PaperCovariance() const {
    Matrix12d normal = Matrix12d::Zero(), spread = Matrix12d::Zero();
    Vector12d squared_norms = Vector12d::Zero();
    for (const Observation& o : observations_.items) {
      const Pose3d base_from_tool = o.base_from_platform * estimate_.mounts.platform_from_tool;
      const Matrix6x12d j = PaperJacobian(base_from_tool);
      const Matrix6x12d carried =
          PaperErrorDerivative(estimate_.mounts.world_from_base * base_from_tool).transpose() * j;
      normal += carried.transpose() * j;
      spread += carried.transpose() * Covariance(o) * carried;
      squared_norms += j.colwise().squaredNorm().transpose();
    }
    const Matrix12d inverse = InverseOfNormal(normal, squared_norms.cwiseSqrt());
    return inverse * spread * inverse.transpose();
  }

  CovarianceOptions Limits() const {
    CovarianceOptions options = LimitsOf(observations_, estimate_.mounts);
    if (!weighting_.levels_estimated)
      options.noise_scale = std::max(
          1.0, std::sqrt(estimate_.chi_square / (6.0 * observations_.items.size() - 12.0)));
    return options;
  }

  // An error of the common tracker pose moves world_from_base alone, by its own amount.
  Matrix12d CommonTrackerCovariance() const {
    Matrix12d common = Matrix12d::Zero();
    if (observations_.tracker_from_world) {
      const Matrix6d carry = InverseAdjoint(estimate_.mounts.world_from_base);
      common.topLeftCorner<6, 6>() =
          carry * observations_.tracker_from_world_covariance * carry.transpose();
    }
    return common;
  }

  void AddWarnings() {
    auto& warnings = estimate_.warnings;
    if (!estimate_.converged) warnings.push_back("no convergence: " + estimate_.message);
    for (const std::string& direction : estimate_.observability.weak_directions)
      warnings.push_back("the data do not determine " + direction);
    // Nothing was stated that could be doubted.
    if (weighting_.levels_estimated && !observations_.has_robot_noise) return;
    AddNoiseDoubts(estimate_.noise_scale, &warnings);
  }

  const Observations& observations_;
  const Weighting& weighting_;
  Estimate& estimate_;
};

}  // namespace

void Judge(const Observations& observations, const Weighting& weighting, Estimate* estimate) {
  Judgement(observations, weighting, estimate).Run();
}

}  // namespace hexcal
