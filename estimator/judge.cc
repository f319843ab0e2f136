// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/judge.h"

#include <algorithm>
#include <cmath>

#include "estimator/judge_common.h"
#include "estimator/linearized.h"
#include "estimator/normal_matrix.h"
#include "estimator/rms.h"
#include "estimator/rounding_noise.h"
#include "residuals/streamed_cost.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

class Judgement {
 public:
  Judgement(const Observations& observations,
            const Weighting& weighting,
            const std::optional<FitSums>& sums,
            Estimate* estimate)
      : observations_(observations),
        weighting_(weighting),
        sums_(sums),
        estimate_(*estimate),
        is_common_(HasCommonCovariance(observations)) {}

  void Run() {
    SetResiduals();
    SetCovariance();
    if (IsRounding()) ScaleToRounding();
    if (HasLoss() || weighting_.paper_error) SetLeastSquares();
    SetIntervals();
    AddWarnings();
  }

 private:
  Matrix6d Covariance(const Observation& o) const {
    return ErrorCovariance(
        o, observations_, estimate_.mounts.platform_from_tool, weighting_.levels);
  }

  // The whitener of every observation, made once where it is the same.
  template <typename Work>
  void ForEachWhitened(const Work& work) const {
    Matrix6d covariance = Matrix6d::Zero(), whitener = Matrix6d::Zero();
    bool is_first = true;
    for (const Observation& o : observations_.items) {
      if (is_first || !is_common_) {
        covariance = Covariance(o);
        whitener = WhitenerOf(covariance);
      }
      is_first = false;
      work(o, covariance, whitener);
    }
  }

  void SetResiduals() {
    estimate_.tracker_from_world = observations_.tracker_from_world;
    const double n = static_cast<double>(observations_.items.size());
    RmsError rms;
    Vector6d mean_variance = Vector6d::Zero();
    estimate_.poses.reserve(observations_.items.size());
    ForEachWhitened(
        [&](const Observation& o, const Matrix6d& covariance, const Matrix6d& whitener) {
          const Vector6d e = PoseError(estimate_.mounts, o.base_from_platform, o.world_from_tool);
          const double squared = (whitener * e).squaredNorm();
          double rho, weight;
          weighting_.loss.Evaluate(squared, &rho, &weight);
          estimate_.poses.push_back({o.label, weight, e});
          estimate_.chi_square += weight * squared;
          if (weight > 0.0) rms.Add(e);
          mean_variance += covariance.diagonal() / n;
        });
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
    ParameterCovariance result = ComputeCovariance(RFactor(), Limits());
    estimate_.observability = result.observability;
    if (weighting_.paper_error) result.covariance = PaperCovariance();

    const int parameters = 12 - result.observability.null_directions;
    const auto counted = std::count_if(estimate_.poses.begin(),
                                       estimate_.poses.end(),
                                       [](const PoseResult& pose) { return pose.weight > 0.0; });
    estimate_.degrees_of_freedom = 6 * static_cast<int>(counted) - parameters;
    estimate_.noise_scale = std::sqrt(estimate_.chi_square / estimate_.degrees_of_freedom);
    // The paper's estimator leaves more than the noise; its covariance knows that already.
    const bool is_scaled = weighting_.levels_estimated && !weighting_.paper_error;
    double scale = is_scaled ? std::pow(estimate_.noise_scale, 2) : 1.0;
    if (HasLoss())
      scale =
          LossCovarianceFactor(observations_, estimate_.mounts, weighting_.levels, weighting_.loss);
    const Matrix12d common = CommonTrackerCovariance();
    estimate_.covariance_unscaled = result.covariance + common;
    estimate_.covariance = (IsSandwich() ? Sandwich() : scale * result.covariance) + common;
  }

  // One step from here: what these residuals are larger than those of least squares by is of the
  // 12 parameters alone, and to second order nothing of it is left.
  void SetLeastSquares() {
    NormalEquations equations;
    equations.normal = Matrix12d::Zero();
    equations.gradient = Vector12d::Zero();
    double squares = 0.0;
    ForEachWhitened([&](const Observation& o, const Matrix6d&, const Matrix6d& whitener) {
      const LinearisedError at = Linearise(o, estimate_.mounts);
      const Vector6d white = whitener * at.error;
      const Matrix6x12d jacobian = whitener * at.jacobian;
      squares += white.squaredNorm();
      equations.normal += jacobian.transpose() * jacobian;
      equations.gradient += jacobian.transpose() * white;
    });
    const double decrease = -equations.gradient.dot(GaussNewtonStep(equations));
    const int all = 6 * static_cast<int>(observations_.items.size());
    estimate_.least_squares = {std::max(0.0, squares - decrease),
                               all - 12 + estimate_.observability.null_directions};
  }

  bool IsRounding() const {
    return weighting_.levels_estimated && !HasLoss() && !weighting_.paper_error &&
           IsOnlyRounding(observations_, estimate_.noise);
  }

  // No level was estimated below one rounding, but a few are left over: by what is left over all
  // are as large as they are.
  void ScaleToRounding() {
    estimate_.noise.position *= estimate_.noise_scale;
    estimate_.noise.orientation *= estimate_.noise_scale;
    estimate_.covariance_unscaled = estimate_.covariance;
    estimate_.chi_square = estimate_.degrees_of_freedom;
    estimate_.noise_scale = 1.0;
  }

  bool HasLoss() const { return weighting_.loss.kind != LossKind::kNone; }
  bool IsSandwich() const { return weighting_.covariance == CovarianceKind::kSandwich; }
  Matrix12d Sandwich() const {
    return SandwichCovariance(observations_, estimate_.mounts, weighting_.levels, weighting_.loss);
  }

  // From the fit's normal matrix, or from the rows themselves.
  Matrix12d RFactor() const {
    if (sums_ && KeepsItsWeakest(sums_->equations.normal))
      return RowsOf(sums_->equations).jacobian.topRows<12>();
    JacobianFactor factor;
    auto pose = estimate_.poses.begin();
    ForEachWhitened([&](const Observation& o, const Matrix6d&, const Matrix6d& whitener) {
      factor.Add(std::sqrt((pose++)->weight) * whitener * Linearise(o, estimate_.mounts).jacobian);
    });
    return factor.R();
  }

  void SetIntervals() {
    const Matrix12d& covariance = estimate_.covariance;
    if (IsSandwich())  // every pose is one draw of it
      estimate_.intervals =
          IntervalsOfScaledNoise(covariance, static_cast<double>(observations_.items.size()) - 1.0);
    else if (HasLoss())
      estimate_.intervals = IntervalsOfScaledNoise(covariance, estimate_.degrees_of_freedom);
    else if (!weighting_.levels_estimated)
      estimate_.intervals = IntervalsOfKnownNoise(covariance);
    // The error of a tracker that stood still is not of these levels.
    else if (sums_ && sums_->variances && !IsRounding() &&
             estimate_.observability.null_directions == 0 && !observations_.tracker_from_world)
      estimate_.intervals =
          IntervalsOfEstimatedNoise(covariance, sums_->equations.components, *sums_->variances);
    else
      estimate_.intervals = IntervalsOfScaledNoise(covariance, estimate_.degrees_of_freedom);
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
    const NoiseMisfit misfit = estimate_.OfNoise();
    AddNoiseDoubts(misfit.Scale(), misfit.degrees_of_freedom, &warnings);
  }

  const Observations& observations_;
  const Weighting& weighting_;
  const std::optional<FitSums>& sums_;
  Estimate& estimate_;
  bool is_common_;
};

}  // namespace

void Judge(const Observations& observations,
           const Weighting& weighting,
           const std::optional<FitSums>& sums,
           Estimate* estimate) {
  Judgement(observations, weighting, sums, estimate).Run();
}

}  // namespace hexcal
