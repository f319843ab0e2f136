// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/marker_pose.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "residuals/pose_error.h"
#include "residuals/spd_inverse.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 30;
constexpr int kMaxHalvings = 12;
// A step of this part of a sigma (squared, and relative to the cost) is the last: it leaves a
// thousandth of itself, and the elimination takes that out to first order.
constexpr double kSmallDecrement = 1e-12;
// Of the cost: below this its changes are rounding.
constexpr double kRounding = 1e-12;

BodyTwist Solve(const BodyTerms& body) {
  BodyTwist twist;
  twist.covariance = SpdInverse(body.normal);
  twist.best = twist.covariance * body.gradient;
  twist.by_shape = twist.covariance.lazyProduct(body.cross);
  return twist;
}

// Of a quadratic form |r - G C unknowns - F shape|^2 with the terms of one body.
void AddDirect(const BodyTerms& body, const MarkerCarry& carry, int shape, NormalEquations* sum) {
  sum->normal.noalias() += carry.transpose() * body.normal * carry;
  sum->gradient.noalias() -= carry.transpose() * body.gradient;
  if (shape < 0) return;
  const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, MarkerLayout::kMaxSize, 3> cross =
      carry.transpose() * body.cross;
  sum->normal.middleCols<3>(shape) += cross;
  sum->normal.middleRows<3>(shape) += cross.transpose();
  sum->normal.block<3, 3>(shape, shape) += body.shape_normal;
  sum->gradient.segment<3>(shape) -= body.shape_gradient;
}

// What a body's readings tell of its own shape once its twist is left to them.
void AddShape(const BodyTerms& body, const BodyTwist& twist, int shape, NormalEquations* sum) {
  if (shape < 0) return;
  sum->normal.block<3, 3>(shape, shape) +=
      body.shape_normal - body.cross.transpose() * twist.by_shape;
  sum->gradient.segment<3>(shape) -= body.shape_gradient - body.cross.transpose() * twist.best;
}

}  // namespace

MarkerNuisance MarkerPoseLikelihood::Start() const {
  MarkerNuisance start;
  start.tracker_from_world =
      data_.tracker_is_static ? unknowns_.tracker_from_world : pose_.tracker_from_world;
  return start;
}

std::array<Pose3d, 2> MarkerPoseLikelihood::TrackerFromBodies(
    const MarkerNuisance& nuisance) const {
  Pose3d base_from_platform = pose_.base_from_platform;
  if (data_.has_robot_noise) base_from_platform = Plus(base_from_platform, RobotMotion(nuisance));
  return {nuisance.tracker_from_world,
          nuisance.tracker_from_world * unknowns_.world_from_base * base_from_platform *
              unknowns_.platform_from_tool};
}

BodyTerms MarkerPoseLikelihood::LineariseBody(int body, const Pose3d& tracker_from_body) const {
  const Eigen::Matrix3d rotation = tracker_from_body.rotation.toRotationMatrix();
  const MarkerShape& shape = data_.bodies[body];
  const int first = body == 0 ? pose_.first_base : pose_.first_tool;
  const int end = body == 0 ? pose_.first_tool : pose_.end;
  BodyTerms terms;
  for (int i = first; i < end; ++i) {
    const MarkerMean& reading = data_.readings[i];
    const Eigen::Vector3d p = unknowns_.p_in_body[body].col(reading.marker);
    const Eigen::Vector3d weight =
        std::sqrt(static_cast<double>(reading.frames)) * sigma_.cwiseInverse();
    const Eigen::Matrix3d turned = weight.asDiagonal() * rotation;
    const Eigen::Vector3d r =
        weight.cwiseProduct(reading.p_in_tracker - (rotation * p + tracker_from_body.translation));
    Eigen::Matrix<double, 3, 6> g;
    g.leftCols<3>() = turned;
    for (int row = 0; row < 3; ++row) g.row(row).tail<3>() = p.cross(turned.row(row).transpose());
    terms.normal.noalias() += g.transpose() * g;
    terms.gradient.noalias() += g.transpose() * r;
    terms.squared += r.squaredNorm();
    if (!shape.is_centroid) continue;
    const Eigen::Matrix3d f = turned * shape.ByParameters(reading.marker);
    terms.cross.noalias() += g.transpose() * f;
    terms.shape_normal.noalias() += f.transpose() * f;
    terms.shape_gradient.noalias() += f.transpose() * r;
  }
  return terms;
}

PoseTerms MarkerPoseLikelihood::Linearise(const MarkerNuisance& nuisance) const {
  const auto tracker_from_body = TrackerFromBodies(nuisance);
  PoseTerms terms;
  for (int body = 0; body < 2; ++body)
    terms.bodies[body] = LineariseBody(body, tracker_from_body[body]);
  terms.squared_draw = nuisance.robot_draw.squaredNorm();
  terms.squared = terms.bodies[0].squared + terms.bodies[1].squared + terms.squared_draw;
  if (HasTool()) CloseLoop(nuisance, &terms);
  return terms;
}

void MarkerPoseLikelihood::CloseLoop(const MarkerNuisance& nuisance, PoseTerms* terms) const {
  const Vector6d motion = RobotMotion(nuisance);
  const Pose3d base_from_platform =
      data_.has_robot_noise ? Plus(pose_.base_from_platform, motion) : pose_.base_from_platform;
  const Pose3d base_from_tool = base_from_platform * unknowns_.platform_from_tool;
  terms->by_base = InverseAdjoint(base_from_tool);
  terms->by_world = InverseAdjoint(unknowns_.world_from_base * base_from_tool);
  if (!HasNuisance()) return;

  terms->twists[1] = Solve(terms->bodies[1]);
  terms->error = terms->twists[1].best;
  Matrix6d covariance = terms->twists[1].covariance;
  if (!data_.tracker_is_static) {
    terms->twists[0] = Solve(terms->bodies[0]);
    terms->error -= terms->by_world * terms->twists[0].best;
    covariance += terms->by_world * terms->twists[0].covariance * terms->by_world.transpose();
  }
  if (data_.has_robot_noise) {
    // How the platform moves, to its own right, where the reported pose's motion grows.
    const Eigen::Vector3d turn = motion.tail<3>();
    Matrix6d by_motion = Matrix6d::Zero();
    by_motion.topLeftCorner<3, 3>() = Exp(turn).conjugate().toRotationMatrix();
    by_motion.bottomRightCorner<3, 3>() = LeftJacobianInverse(-turn).inverse();
    terms->by_robot = InverseAdjoint(unknowns_.platform_from_tool) * by_motion * pose_.robot_root;
    terms->error += terms->by_robot * nuisance.robot_draw;
    covariance += terms->by_robot * terms->by_robot.transpose();
  }
  terms->weight = SpdInverse(covariance);
}

MarkerNuisance MarkerPoseLikelihood::Moved(const MarkerNuisance& nuisance,
                                           const PoseTerms& terms,
                                           double factor,
                                           double* decrement) const {
  const Vector6d force = terms.weight * terms.error;
  MarkerNuisance moved = nuisance;
  Vector6d of_tool = Vector6d::Zero();
  *decrement = 0.0;
  if (!data_.tracker_is_static) {
    const Vector6d x =
        terms.twists[0].best + terms.twists[0].covariance * (terms.by_world.transpose() * force);
    moved.tracker_from_world = Plus(nuisance.tracker_from_world, Vector6d(factor * x));
    of_tool += terms.by_world * x;
    *decrement += x.dot(terms.bodies[0].normal * x);
  }
  if (data_.has_robot_noise) {
    const Vector6d u = terms.by_robot.transpose() * force - nuisance.robot_draw;
    moved.robot_draw += factor * u;
    of_tool += terms.by_robot * u;
    *decrement += u.squaredNorm();
  }
  *decrement += of_tool.dot(terms.bodies[1].normal * of_tool);
  return moved;
}

MarkerNuisance MarkerPoseLikelihood::Eliminate(PoseTerms* terms) const {
  MarkerNuisance best = Start();
  *terms = Linearise(best);
  if (!HasNuisance()) return best;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    double decrement = 0.0;
    MarkerNuisance next = Moved(best, *terms, 1.0, &decrement);
    if (!(decrement < 0.25 * last) && !(decrement > kRounding * terms->squared)) break;
    PoseTerms there = Linearise(next);
    double factor = 1.0;
    for (int k = 0; k < kMaxHalvings && !(there.squared <= (1.0 + kRounding) * terms->squared);
         ++k) {
      factor *= 0.5;
      double ignored = 0.0;
      next = Moved(best, *terms, factor, &ignored);
      there = Linearise(next);
    }
    if (!(there.squared <= (1.0 + kRounding) * terms->squared)) break;
    best = next;
    *terms = there;
    last = decrement;
    if (decrement <= kSmallDecrement * terms->squared) break;
  }
  return best;
}

MarkerCarry MarkerPoseLikelihood::CarryOf(const PoseTerms& terms,
                                          const MarkerLayout& layout) const {
  MarkerCarry carry = MarkerCarry::Zero(6, layout.size);
  carry.leftCols<6>() = terms.by_base;
  carry.middleCols<6>(6).setIdentity();
  if (layout.tracker >= 0) carry.middleCols<6>(layout.tracker) = terms.by_world;
  if (!HasNuisance()) return carry;  // the shapes are added directly
  if (layout.shape[0] >= 0 && layout.tracker < 0)
    carry.middleCols<3>(layout.shape[0]) = -terms.by_world * terms.twists[0].by_shape;
  if (layout.shape[1] >= 0) carry.middleCols<3>(layout.shape[1]) = terms.twists[1].by_shape;
  return carry;
}

void MarkerPoseLikelihood::AddReduced(const PoseTerms& terms,
                                      const MarkerLayout& layout,
                                      NormalEquations* sum) const {
  sum->squared_norm += terms.squared;
  if (HasTool()) {
    const Vector6d e = PoseError({unknowns_.world_from_base, unknowns_.platform_from_tool},
                                 pose_.base_from_platform,
                                 pose_.world_from_tool);
    sum->position_squares += e.head<3>().squaredNorm();
    sum->orientation_squares += e.tail<3>().squaredNorm();
    ++sum->poses;
  }
  if (layout.tracker >= 0) {
    MarkerCarry carry = MarkerCarry::Zero(6, layout.size);
    carry.middleCols<6>(layout.tracker).setIdentity();
    AddDirect(terms.bodies[0], carry, layout.shape[0], sum);
  } else {
    AddShape(terms.bodies[0], terms.twists[0], layout.shape[0], sum);
  }
  if (!HasTool()) return;
  const MarkerCarry carry = CarryOf(terms, layout);
  if (!HasNuisance()) return AddDirect(terms.bodies[1], carry, layout.shape[1], sum);
  AddShape(terms.bodies[1], terms.twists[1], layout.shape[1], sum);
  const MarkerCarry weighted = terms.weight * carry;
  sum->normal.noalias() += carry.transpose() * weighted;
  sum->gradient.noalias() -= weighted.transpose() * terms.error;
}

Matrix6d MarkerPoseLikelihood::ToolCovariance(const PoseTerms& terms) const {
  if (!HasTool()) return Matrix6d::Zero();
  const Matrix6d covariance = SpdInverse(terms.bodies[1].normal);
  if (data_.tracker_is_static) return covariance;
  return covariance + terms.by_world * terms.twists[0].covariance * terms.by_world.transpose();
}

double MarkerPoseLikelihood::DrawFreedom(const PoseTerms& terms,
                                         const MarkerLayout& layout,
                                         const Eigen::MatrixXd& inverse) const {
  if (!HasTool() || !data_.has_robot_noise) return 0.0;
  const Matrix6d told = terms.weight * terms.by_robot;
  const MarkerCarry carry = CarryOf(terms, layout);
  const Matrix6d spread = carry * inverse * carry.transpose();
  return terms.by_robot.cwiseProduct(told).sum() - told.cwiseProduct(spread * told).sum();
}

}  // namespace hexcal
