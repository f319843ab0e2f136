// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/gap_model.h"

#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "discovery/site_jacobians.h"
#include "estimator/rounding_noise.h"
#include "geometry/linear_algebra.h"
#include "model/described_effect.h"
#include "model/predict.h"

namespace hexcal {
namespace {

using Motion = Corrections<double>;

// d(corrections) / d(coefficient k of a form) at one visit.
Motion MotionOf(const FormDefinition& form, int k, const Visit& visit) {
  if (form.reading == FormDefinition::Reading::kLinear) {
    Motion sum;
    bool is_first = true;
    for (Eigen::Index n = 0; n < form.directions.rows(); ++n) {
      const double share = form.directions(n, k);
      if (share == 0.0) continue;
      CHECK(is_first || form.effect.name.rfind("leg", 0) == 0) << "only legs move together";
      const Motion one = CorrectionsBy(form.effect, static_cast<int>(n), visit);
      if (is_first)
        sum = one, sum.leg *= share, is_first = false;
      else
        sum.leg += share * one.leg;
    }
    return sum;
  }
  const EffectKind& kind = *FindEffectKind(form.effect.name);
  Effect effect = form.effect;
  if (form.reading == FormDefinition::Reading::kCompliance) {
    if (k > 0) effect.parameters[kind.OffsetOf("compliance")] = kind.ScaleOf(0);
    return CorrectionsBy(effect, k, visit);
  }
  LOG(FATAL) << "a form of another kind: " << form.effect.name;
}

// Sine and cosine of all legs at one visit, for amplitudes 1.
std::array<Vector6d, 2> WavesOf(const FormDefinition& form, const Visit& visit) {
  const EffectKind& kind = *FindEffectKind(form.effect.name);
  Effect effect = form.effect;
  effect.parameters.segment<kNumLegs>(kind.OffsetOf("amplitude")).setOnes();
  std::array<Vector6d, 2> waves;
  for (const int part : {0, 1}) {
    effect.parameters.segment<kNumLegs>(kind.OffsetOf("phase"))
        .setConstant(part == 0 ? 0.0 : 0.5 * M_PI);
    waves[part] = CorrectionsOf({effect}, visit).leg;
  }
  return waves;
}

// Sine, then cosine, of each leg; a single pair moves all legs.
Motion PartOf(const std::array<Vector6d, 2>& waves, const FormDefinition& form, int k) {
  Motion motion;
  if (form.size() == 2 * kNumLegs)
    motion.leg[k / 2] = waves[k % 2][k / 2];
  else
    motion.leg = waves[k % 2];
  return motion;
}

// Columns of all forms at one machine.
class ColumnWriter {
 public:
  ColumnWriter(const FormLibrary& library, int poses, int shape_rows, LinearProblem* problem)
      : library_(library), shape_rows_(shape_rows), problem_(problem) {
    LayOut();
    all_.setZero(6 * poses, columns_);
  }

  // Of one pose; shape_at: its first shape row.
  void Write(int pose,
             const SiteJacobians& sites,
             const SeenPose& seen,
             const Motion& here,
             const Visit& visit,
             int shape_at) {
    std::array<Vector6d, 2> waves;
    for (std::size_t f = 0; f < library_.forms.size(); ++f) {
      const FormDefinition& form = library_.forms[f];
      if (form.shares >= 0) continue;
      const bool is_wave = form.reading == FormDefinition::Reading::kPeriodic;
      if (is_wave) waves = WavesOf(form, visit);
      for (int k = 0; k < form.size(); ++k) {
        const Motion motion = is_wave ? PartOf(waves, form, k) : MotionOf(form, k, visit);
        const int column = problem_->forms[f].first + k;
        auto cell = all_.block<6, 1>(6 * pose, column);
        cell = sites.Apply(motion);
        if (!MovesReadings(motion)) continue;
        const SeenMotion moved = SeenBy(seen, here, motion);
        cell += moved.pose;
        if (moved.shape.size() == 0) continue;
        if (problem_->shape_of[column] < 0) AddShapeColumn(column);
        shape_[problem_->shape_of[column]].segment(shape_at, moved.shape.size()) = moved.shape;
      }
    }
  }

  void Finish() {
    Eigen::MatrixXd shape(shape_rows_, static_cast<Eigen::Index>(shape_.size()));
    for (std::size_t k = 0; k < shape_.size(); ++k) shape.col(k) = shape_[k];
    problem_->columns = std::make_shared<Eigen::MatrixXd>(std::move(all_));
    problem_->shape_columns = std::make_shared<Eigen::MatrixXd>(std::move(shape));
  }

 private:
  void LayOut() {
    std::vector<double> scale;
    for (const FormDefinition& definition : library_.forms) {
      Form form;
      form.family = definition.family;
      form.index = definition.effect.index;
      form.size = definition.size();
      form.log_prior = definition.log_prior;
      form.definition = static_cast<int>(problem_->forms.size());
      form.first = definition.shares < 0
                       ? columns_
                       : problem_->forms[definition.shares].first + definition.shares_from;
      if (definition.shares < 0) {
        columns_ += form.size;
        scale.insert(scale.end(), definition.scale.begin(), definition.scale.end());
      }
      problem_->forms.push_back(form);
    }
    problem_->scale = Eigen::Map<Eigen::VectorXd>(scale.data(), columns_);
    problem_->shape_of.assign(columns_, -1);
    problem_->families = library_.families;
  }

  void AddShapeColumn(int column) {
    problem_->shape_of[column] = static_cast<int>(shape_.size());
    shape_.push_back(Eigen::VectorXd::Zero(shape_rows_));
  }

  const FormLibrary& library_;
  const int shape_rows_;
  LinearProblem* problem_;
  int columns_ = 0;
  Eigen::MatrixXd all_;
  std::vector<Eigen::VectorXd> shape_;
};

// The covariance of a pose's error: what the tracker is stated to do (or one level for positions
// and one for orientations), and a robot that does not repeat, in its own frame.
void AddComponents(const GapData& data,
                   const SiteJacobians& sites,
                   const SeenPose& seen,
                   LinearProblem* problem) {
  const Measurement& measurement = *data.dataset->measurement;
  const bool by_markers = measurement.kind == Measurement::Kind::kMarkers;
  std::vector<Matrix6d> components;
  Matrix6d position = Matrix6d::Zero(), orientation = Matrix6d::Zero();
  position.topLeftCorner<3, 3>().setIdentity();
  orientation.bottomRightCorner<3, 3>().setIdentity();
  if (by_markers || data.tool_poses.has_covariance) {
    Matrix6d stated = seen.covariance;
    const Matrix6d& carry = sites.platform_twist;
    if (!data.reported_covariances.empty())
      stated += carry * data.reported_covariances[seen.row] * carry.transpose();
    components = {
        stated, carry * position * carry.transpose(), carry * orientation * carry.transpose()};
  } else {
    components = {position, orientation};
  }
  problem->components.resize(components.size());
  for (std::size_t c = 0; c < components.size(); ++c)
    problem->components[c].push_back(components[c]);
}

// What rounding makes of each component: of the robot's, which is known no better than the tracker
// sees, nothing.
void SetLeastFactors(const std::vector<SeenPose>& seen, LinearProblem* problem) {
  double size = 0.0;
  for (const SeenPose& pose : seen) size = std::max(size, pose.world_from_tool.translation.norm());
  const double rounding = kRoundingsOfNoise * std::numeric_limits<double>::epsilon();
  const auto factor = [&](const std::vector<Matrix6d>& component) {
    double position = 0.0, orientation = 0.0;
    for (const Matrix6d& covariance : component) {
      position = std::max(position, covariance.diagonal().head<3>().maxCoeff());
      orientation = std::max(orientation, covariance.diagonal().tail<3>().maxCoeff());
    }
    const double by_position = position > 0.0 ? std::pow(rounding * size, 2) / position : 0.0;
    const double by_orientation = orientation > 0.0 ? std::pow(rounding, 2) / orientation : 0.0;
    return std::max(by_position, by_orientation);
  };
  problem->least_factor.assign(problem->components.size(), 0.0);
  const std::size_t measured = problem->components.size() == 2 ? 2 : 1;
  for (std::size_t c = 0; c < measured; ++c)
    problem->least_factor[c] = factor(problem->components[c]);
}

Eigen::VectorXd ShapeOf(const SeenPose& seen) {
  std::array<Eigen::VectorXd, 2> parts;
  for (int b = 0; b < 2; ++b)
    if (!seen.bodies[b].markers.empty()) parts[b] = seen.bodies[b].Misfit();
  Eigen::VectorXd all(parts[0].size() + parts[1].size());
  all << parts[0], parts[1];
  return all;
}

void CollectShape(const std::vector<SeenPose>& seen, LinearProblem* problem) {
  std::vector<double> rows;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Eigen::VectorXd shape = ShapeOf(seen[k]);
    rows.insert(rows.end(), shape.begin(), shape.end());
    problem->shape_pose.insert(problem->shape_pose.end(), shape.size(), static_cast<int>(k));
    problem->shape_freedom.push_back(static_cast<int>(shape.size()));
  }
  problem->shape_error =
      Eigen::Map<Eigen::VectorXd>(rows.data(), static_cast<Eigen::Index>(rows.size()));
  problem->shape_nuisance.setZero(problem->shape_error.size(), 12);
}

// Coordinates of all markers of both bodies x this pose's shape rows.
Eigen::MatrixXd WholeBasis(const SeenPose& seen, const std::array<int, 2>& markers) {
  const Eigen::Index columns =
      seen.bodies[0].shape_basis.cols() + seen.bodies[1].shape_basis.cols();
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(3 * (markers[0] + markers[1]), columns);
  Eigen::Index at = 0;
  for (int b = 0; b < 2; ++b) {
    const SeenBody& body = seen.bodies[b];
    for (std::size_t i = 0; i < body.markers.size(); ++i)
      whole.block(3 * (b * markers[0] + body.markers[i]), at, 3, body.shape_basis.cols()) =
          body.shape_basis.middleRows(3 * static_cast<Eigen::Index>(i), 3);
    at += body.shape_basis.cols();
  }
  return whole;
}

// Every marker off its place, and moving away from it over the poses.
Eigen::MatrixXd MarkerTrend(const SeenPose& seen, const std::array<int, 2>& markers, double order) {
  const int all = 3 * (markers[0] + markers[1]);
  Eigen::MatrixXd trend;
  for (int n = 0; n < all; ++n) {
    Motion motion;
    for (int b = 0; b < 2; ++b) motion.markers[b] = Eigen::Matrix3Xd::Zero(3, markers[b]);
    const int marker = n / 3, body = marker < markers[0] ? 0 : 1;
    motion.markers[body](n % 3, marker - body * markers[0]) = 1.0;
    const Eigen::VectorXd shape = SeenBy(seen, Motion(), motion).shape;
    if (n == 0) trend.resize(shape.size(), 2 * all);
    trend.col(n) = shape, trend.col(all + n) = order * shape;
  }
  return trend;
}

}  // namespace

GapData MakeGapData(const Dataset& dataset, const std::vector<Pose3d>& reported) {
  GapData data;
  data.dataset = &dataset;
  data.hexapod = dataset.hexapod;
  data.visits = MakeVisits(dataset, data.hexapod ? &*data.hexapod : nullptr, reported);
  data.tool_poses = ComputeToolPoses(dataset);
  for (const ToolPose& pose : data.tool_poses.poses) data.rows.push_back(pose.pose);
  data.reported_covariances = ReportedCovariances(dataset, reported);
  return data;
}

std::optional<GapProblem> MakeGapProblemInReach(const GapData& data,
                                                const Mounts& mounts,
                                                const std::vector<Effect>& effects,
                                                const FormLibrary& library) {
  GapProblem problem;
  const HexapodGeometry* hexapod = data.hexapod ? &*data.hexapod : nullptr;
  std::vector<Motion> corrections;
  if (!effects.empty())
    for (const Visit& visit : data.visits) corrections.push_back(CorrectionsOf(effects, visit));
  problem.seen = SeePoses(*data.dataset, data.tool_poses, corrections);
  const int poses = static_cast<int>(problem.seen.size());

  LinearProblem& linear = problem.linear;
  linear.poses = poses;
  linear.error.resize(6 * poses);
  linear.nuisance.resize(6 * poses, 12);
  problem.trend.resize(6 * poses, 12);
  CollectShape(problem.seen, &linear);
  const auto& bodies = data.dataset->measurement->bodies;
  const std::array<int, 2> markers = {static_cast<int>(bodies[0].markers.size()),
                                      static_cast<int>(bodies[1].markers.size())};
  linear.shape_trend.resize(linear.shape_error.size(), 6 * (markers[0] + markers[1]));
  ColumnWriter writer(library, poses, static_cast<int>(linear.shape_error.size()), &linear);
  int shape_at = 0;
  for (int k = 0; k < poses; ++k) {
    const SeenPose& seen = problem.seen[k];
    const Visit& visit = data.visits[seen.row];
    const Motion here = corrections.empty() ? Motion() : corrections[seen.row];
    const ForwardPose at = Forward(mounts, hexapod, visit, here);
    if (!at.reached) return std::nullopt;
    problem.predicted.push_back(at.world_from_tool);
    linear.error.segment<6>(6 * k) = Minus(seen.world_from_tool, at.world_from_tool);
    const SiteJacobians sites = SitesOf(mounts, hexapod, visit, here, at);
    linear.nuisance.middleRows<6>(6 * k) = sites.mounts;
    const double order = poses > 1 ? static_cast<double>(k) / (poses - 1) - 0.5 : 0.0;
    problem.trend.middleRows<6>(6 * k) = order * sites.mounts;
    AddComponents(data, sites, seen, &linear);
    writer.Write(k, sites, seen, here, visit, shape_at);
    if (linear.shape_freedom[k] > 0)
      linear.shape_trend.middleRows(shape_at, linear.shape_freedom[k]) =
          MarkerTrend(seen, markers, order);
    linear.shape_basis.push_back(WholeBasis(seen, markers));
    shape_at += linear.shape_freedom[k];
    if (hexapod != nullptr) problem.legs_by_error.push_back(PseudoInverse(sites.leg, 1e-12));
  }
  writer.Finish();
  SetLeastFactors(problem.seen, &linear);
  return problem;
}

GapProblem MakeGapProblem(const GapData& data,
                          const Mounts& mounts,
                          const std::vector<Effect>& effects,
                          const FormLibrary& library) {
  std::optional<GapProblem> problem = MakeGapProblemInReach(data, mounts, effects, library);
  CHECK(problem) << "effects that put legs out of reach";
  return *std::move(problem);
}

}  // namespace hexcal
