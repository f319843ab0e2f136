// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/registration_error.h"
#include "estimator/rounding_noise.h"
#include "geometry/rotation_angles.h"
#include "report/audit_budget.h"
#include "report/audit_model.h"
#include "report/audit_noise.h"
#include "report/decide.h"
#include "report/held_out.h"
#include "report/missing_effects.h"

namespace hexcal {
namespace {

constexpr double kProbability = 0.95;
constexpr double kMostLost = 0.01;             // of the repetitions, without convergence
constexpr double kAlpha = 0.01, kPower = 0.8;  // of the smallest errors that would be found

// The robot's own error as a source: from the requirement file, else from the dataset.
std::optional<StatedSource> RobotOf(const AuditInput& input) {
  if (input.requirements && input.requirements->robot) return input.requirements->robot;
  if (!input.observations.has_robot_noise) return std::nullopt;
  Vector6d mean = Vector6d::Zero();
  for (const Observation& o : input.observations.items) mean += o.robot_covariance.diagonal();
  mean /= static_cast<double>(input.observations.items.size());
  StatedSource robot;
  robot.origin = "the dataset's robot_poses: noise, mean over poses and axes";
  robot.source.position = std::sqrt(mean.head<3>().mean());
  robot.source.orientation = std::sqrt(mean.tail<3>().mean());
  return robot;
}

Requirements RequirementsOf(const AuditInput& input) {
  Requirements requirements = input.requirements.value_or(Requirements{});
  requirements.robot = RobotOf(input);
  if (requirements.robot) requirements.robot->source.name = "robot's own error";
  if (requirements.points.empty()) requirements.points.push_back({"origin of frame T"});
  return requirements;
}

std::vector<BodyReport> BodiesOf(const Dataset& dataset,
                                 const Estimate& estimate,
                                 const Audit& audit) {
  std::vector<BodyReport> bodies;
  if (dataset.measurement->kind != Measurement::Kind::kMarkers) return bodies;
  const auto sigma =
      dataset.measurement->marker_sigma ? dataset.measurement->marker_sigma : estimate.noise.marker;
  if (!sigma) return bodies;
  for (int b = 0; b < 2; ++b) {
    const MarkerBody& body = dataset.measurement->bodies[b];
    if (body.is_centroid) continue;
    BodyReport report;
    report.name = b == 0 ? "base" : "tool";
    report.markers = body.p_in_body.cols();
    report.sigma = std::sqrt(sigma->squaredNorm() / 3.0);
    report.fiducial = FiducialRegistrationError(report.markers, report.sigma);
    if (b == 1)
      for (const NamedPoint& point : audit.requirements.points)
        report.at_points.push_back(
            TargetRegistrationError(body.p_in_body, report.sigma, point.p_in_tool));
    bodies.push_back(report);
  }
  return bodies;
}

PointAt AtPlace(const TargetError& error, const NamedPoint& point, const Place& place) {
  const TargetCovariance at = error.At(place.base_from_platform, point.p_in_tool, place.row);
  const double calibration = at.calibration.trace();
  return {place,
          at.Rms(),
          at.Quantile(kProbability),
          calibration > 0.0 ? at.by_priors.trace() / calibration : 0.0,
          at.degrees_of_freedom};
}

PointReport ReportPoint(const Audit& audit,
                        const NamedPoint& point,
                        const std::vector<Place>& places,
                        const AuditInput& input) {
  const std::vector<ErrorSource> sources = SourcesOf(audit, point);
  const TargetError error = ErrorOf(audit, point);
  PointReport report;
  report.point = point;
  report.centre = AtPlace(error, point, {"", PoseFromVector(audit.workspace.Centre())});
  report.worst =
      AtPlace(error, point, WorstPlace(error, point.p_in_tool, places, kProbability).place);
  const Pose3d& pose = report.worst.place.base_from_platform;
  report.budget = BudgetOf(audit, point, pose);
  const PropagationCheck& propagation = audit.comparison.propagation;
  if (propagation.done)
    report.check = CheckTarget(audit.repeated.estimate,
                               sources,
                               propagation,
                               pose,
                               point.p_in_tool,
                               kProbability,
                               input.seed,
                               audit.grown,
                               {report.worst.length_95,
                                std::min(report.worst.degrees_of_freedom,
                                         static_cast<double>(audit.estimate.degrees_of_freedom))});
  report.validation =
      ValidatePoint(UsedOf(audit.poses, audit.estimate),
                    audit.grown ? audit.grown->solution().cleaned : input.observations,
                    audit.estimate.mounts,
                    point.p_in_tool);
  report.map = MapAccuracy(error, point.p_in_tool, audit.workspace, input.dataset, kProbability);
  return report;
}

std::vector<std::string> NamesOf(const std::vector<NamedPoint>& points) {
  std::vector<std::string> names;
  for (const NamedPoint& point : points) names.push_back(point.name);
  return names;
}

std::optional<BaseAndTool> InitialOf(const Dataset& dataset) {
  if (!dataset.initial) return std::nullopt;
  return BaseAndTool{dataset.initial->world_from_base, dataset.initial->platform_from_tool};
}

std::vector<std::string> DoubtsOf(const Audit& audit) {
  std::vector<std::string> doubts;
  const Estimate& estimate = audit.estimate;
  if (!audit.robot_is_stated)
    doubts.push_back(
        "nothing is stated of the robot's own error (robot: in the requirement file, or noise in "
        "the dataset's robot_poses)");
  if (audit.global.is_too_large)
    doubts.push_back("what is left over is more than the stated noise explains");
  if (audit.global.is_rounding) doubts.push_back(kOnlyRounding);
  if (!audit.global.is_rounding && audit.held_out.inside < audit.held_out.fewest)
    doubts.push_back(fmt::format(
        "only {} of {} poses lie within the 95 % region that the others predict for them",
        audit.held_out.inside,
        audit.held_out.poses));
  const bool is_used = std::all_of(estimate.poses.begin(),
                                   estimate.poses.end(),
                                   [](const PoseResult& pose) { return pose.weight == 1.0; });
  if (!estimate.outliers.empty() && is_used)
    doubts.push_back(fmt::format("{} that the others contradict {} used all the same",
                                 estimate.outliers.size() == 1
                                     ? std::string("a pose")
                                     : fmt::format("{} poses", estimate.outliers.size()),
                                 estimate.outliers.size() == 1 ? "was" : "were"));
  for (const NamedPoint& point : audit.requirements.points)
    if (point.pivot)
      for (const std::string& doubt : point.pivot->doubts)
        doubts.push_back(fmt::format("of the pivoting of {} {}", point.name, doubt));
  const PropagationCheck& repeated = audit.comparison.propagation;
  if (repeated.not_converged > kMostLost * repeated.draws)
    doubts.push_back(fmt::format("{} of {} repetitions of the calibration did not converge",
                                 repeated.not_converged,
                                 repeated.draws));
  AddDoubtsOfNoise(audit, &doubts);
  AddDoubtsOfReadings(audit.readings, &doubts);
  AddDoubtsOfModel(audit, &doubts);
  AddDoubtsOfMissing(audit, &doubts);
  return doubts;
}

// How the fit has weighed the poses: those that were rejected by nothing.
WeightedAs WeightedAsIn(const AuditInput& input, const Estimate& estimate) {
  WeightedAs weighted;
  for (const PoseResult& pose : estimate.poses) weighted.weights.push_back(pose.weight);
  if (input.header.loss.kind != LossKind::kNone)
    weighted.variance =
        LossCovarianceFactor(input.observations, estimate.mounts, input.levels, input.header.loss);
  return weighted;
}

RepeatedAs UsuallyRepeated(const Audit& audit) {
  if (audit.grown)
    return {audit.estimate, true, "base, tool and the effects of the model together"};
  const bool is_audits = audit.header.solver == "nonlinear" && audit.header.residual == "pose" &&
                         audit.header.loss.kind == LossKind::kNone;
  return {audit.comparison.reference, is_audits, "the nonlinear fit by poses"};
}

}  // namespace

std::string_view NameOf(Compliance compliance) {
  switch (compliance) {
    case Compliance::kPass:
      return "PASS";
    case Compliance::kFail:
      return "FAIL";
    case Compliance::kInconclusive:
      return "INCONCLUSIVE";
    case Compliance::kNotAsked:
      break;
  }
  return "none";
}

std::vector<ErrorSource> SourcesOf(const Audit& audit, const NamedPoint& point) {
  std::vector<ErrorSource> sources = audit.sources;
  sources.push_back(point.Source());
  return sources;
}

TargetError ErrorOf(const Audit& audit, const NamedPoint& point) {
  return {audit.estimate, SourcesOf(audit, point), audit.grown};
}

Audit MakeAudit(AuditInput input) {
  Audit audit;
  audit.header = input.header;
  audit.description = input.dataset.description;
  audit.requirements = RequirementsOf(input);
  audit.estimate = std::move(input.estimate);
  audit.comparison = std::move(input.comparison);
  audit.grown = input.grown;
  audit.missing = std::move(input.missing);
  audit.why_not_screened = std::move(input.why_not_screened);
  audit.repeated = input.repeated ? std::move(*input.repeated) : UsuallyRepeated(audit);
  audit.robot_is_stated = audit.requirements.robot.has_value();
  if (audit.robot_is_stated) audit.sources.push_back(audit.requirements.robot->source);
  for (const StatedSource& stated : audit.requirements.sources)
    audit.sources.push_back(stated.source);
  audit.workspace = MakeWorkspace(audit.requirements.workspace, input.observations);
  audit.frames = FrameGraphOf(input.dataset, NamesOf(audit.requirements.points));
  audit.rows = CountRows(input.dataset, audit.estimate);
  audit.design = PoseDesignOf(input.dataset, input.observations);
  audit.scene = MakeScene(input.dataset, input.observations, audit.estimate);
  audit.left_over = MakeLeftOver(input.dataset, input.observations, audit.estimate);
  audit.global = GlobalTestOf(audit.estimate);
  audit.global.is_rounding = IsOnlyRounding(input.observations, audit.estimate.noise);
  if (!audit.global.is_rounding) audit.axis_noise = AxisNoiseOf(input.dataset, input.observations);
  audit.correlations = StrongCorrelations(audit.estimate);
  audit.bodies = BodiesOf(input.dataset, audit.estimate, audit);
  if (audit.estimate.IsTrustworthy()) {
    audit.poses = audit.grown ? CheckPoses(audit.grown->solution(), kAlpha, kPower)
                              : CheckPoses(input.observations,
                                           audit.estimate.mounts,
                                           input.levels,
                                           kAlpha,
                                           kPower,
                                           WeightedAsIn(input, audit.estimate));
    audit.held_out = HeldOutTestOf(UsedOf(audit.poses, audit.estimate));
    if (!audit.grown && !audit.global.is_rounding)
      audit.readings = CheckReadings(
          input.dataset, input.observations, audit.estimate, {kAlpha, kPower, input.threads});
  }
  std::vector<Place> places = GridOf(audit.workspace, input.dataset);
  if (audit.grown) KeepReached(*audit.grown, &places);
  audit.places = places.size();
  const std::vector<Place> poses =
      audit.grown ? PosesOf(audit.grown->solution()) : PosesOf(input.observations);
  if (audit.estimate.IsTrustworthy() && !places.empty())
    for (const NamedPoint& point : audit.requirements.points)
      audit.points.push_back(ReportPoint(audit, point, places, input));
  audit.doubts = DoubtsOf(audit);
  for (const Requirement& requirement : audit.requirements.requirements)
    audit.decisions.push_back(Decide(
        audit, requirement, requirement.over == Requirement::Places::kWorkspace ? places : poses));
  audit.compliance = Together(audit.decisions);
  const Pose3d centre = PoseFromVector(audit.workspace.Centre());
  audit.linearity =
      CheckLinearity(audit.grown ? audit.grown->solution().cleaned : input.observations,
                     InitialOf(input.dataset),
                     input.levels,
                     audit.comparison,
                     audit.requirements.points,
                     centre,
                     places);
  if (input.earlier)
    audit.change = ChangeOf(
        *input.earlier, audit.estimate, audit.header.readings, audit.requirements.points, centre);
  return audit;
}

}  // namespace hexcal
