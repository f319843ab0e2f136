// SPDX-License-Identifier: BSD-3-Clause
#include "report/linearity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/target_error.h"

namespace hexcal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d Predicted(const BaseAndTool& mounts, const Pose3d& pose, const Eigen::Vector3d& p) {
  return mounts.world_from_base * pose * mounts.platform_from_tool * p;
}

// RMS length of the error that the calibration alone makes there, its noise taken as known.
double CalibrationRms(const Estimate& estimate, const Pose3d& pose, const Eigen::Vector3d& p) {
  const auto jacobian = TargetJacobian(estimate.mounts, pose, p);
  return std::sqrt((jacobian * estimate.covariance_unscaled * jacobian.transpose()).trace());
}

void CompareParameters(const Estimate& nonlinear, LinearizedSolution* solution) {
  const Estimate& linearized = solution->estimate;
  solution->over_u << Minus(linearized.mounts.world_from_base, nonlinear.mounts.world_from_base),
      Minus(linearized.mounts.platform_from_tool, nonlinear.mounts.platform_from_tool);
  for (int i = 0; i < 12; ++i) {
    const bool is_determined =
        nonlinear.observability.determined[i] && linearized.observability.determined[i];
    const double u = std::sqrt(nonlinear.covariance(i, i));
    solution->over_u[i] = is_determined ? solution->over_u[i] / u : kNaN;
    solution->ratio[i] =
        is_determined
            ? std::sqrt(linearized.covariance_unscaled(i, i) / nonlinear.covariance_unscaled(i, i))
            : kNaN;
  }
}

LinearizedSolution::AtPoint ComparePoint(const Estimate& linearized,
                                         const Estimate& nonlinear,
                                         const Eigen::Vector3d& p,
                                         const Pose3d& centre,
                                         const std::vector<Place>& places) {
  const auto distance = [&](const Pose3d& pose) {
    return (Predicted(linearized.mounts, pose, p) - Predicted(nonlinear.mounts, pose, p)).norm();
  };
  LinearizedSolution::AtPoint at;
  at.centre = at.largest = distance(centre);
  for (const Place& place : places)
    at.largest = std::max(at.largest, distance(place.base_from_platform));
  at.ratio = CalibrationRms(linearized, centre, p) / CalibrationRms(nonlinear, centre, p);
  return at;
}

std::vector<RepeatedParameter> Repeated(const PropagationCheck& propagation) {
  constexpr double kHalfWidth = 1.959963984540054;  // of the normal distribution's 95 %
  std::vector<RepeatedParameter> parameters;
  const auto& draws = propagation.estimates;
  if (!propagation.done || draws.cols() < 2) return parameters;
  const double n = static_cast<double>(draws.cols());
  for (int i = 0; i < 12; ++i) {
    const double sigma = propagation.intervals[i].sigma;
    const auto centred = draws.row(i).array() - draws.row(i).mean();
    RepeatedParameter parameter;
    parameter.ratio = std::sqrt(centred.square().sum() / (n - 1.0)) / sigma;
    const auto inside = (draws.row(i).array().abs() <= kHalfWidth * sigma).count();
    parameter.coverage = CoverageOf(inside, draws.cols(), 0.95);
    parameters.push_back(parameter);
  }
  return parameters;
}

}  // namespace

Linearity CheckLinearity(const Observations& observations,
                         const std::optional<BaseAndTool>& initial,
                         const NoiseLevels& levels,
                         const Comparison& comparison,
                         const std::vector<NamedPoint>& points,
                         const Pose3d& centre,
                         const std::vector<Place>& places) {
  Linearity linearity;
  const Estimate& nonlinear = comparison.reference;
  CalibrateOptions options;
  options.solver = Solver::kLinearized;
  if (!observations.tool_noise_is_known) options.noise = levels;
  for (const Method method : {Method::kPaper, Method::kTwist}) {
    options.linearized.error = method == Method::kPaper ? LinearizedOptions::Error::kPaper
                                                        : LinearizedOptions::Error::kTwist;
    LinearizedSolution solution;
    solution.name = InfoOf(method).name;
    solution.title = InfoOf(method).title;
    solution.estimate = Calibrate(observations, initial, options);
    CompareParameters(nonlinear, &solution);
    for (const NamedPoint& point : points)
      solution.points.push_back(
          ComparePoint(solution.estimate, nonlinear, point.p_in_tool, centre, places));
    linearity.solutions.push_back(std::move(solution));
  }
  linearity.repeated = Repeated(comparison.propagation);
  return linearity;
}

}  // namespace hexcal
