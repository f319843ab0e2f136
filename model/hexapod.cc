// SPDX-License-Identifier: BSD-3-Clause
#include "model/hexapod.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "geometry/align_points.h"

namespace hexcal {
namespace {

constexpr double kTolerance = 1e-12;  // of the largest leg
constexpr int kMaxIterations = 100;
constexpr double kLargestTurn = 1.0;   // rad a step: beyond it the linear model means nothing
constexpr double kLargestShift = 0.5;  // of the largest leg a step

// Leg vectors from base joint to platform joint, seen from the platform: 3 x 6, m.
Matrix36d LegsInPlatform(const HexapodGeometry& hexapod, const Pose3d& base_from_platform) {
  const Pose3d platform_from_base = base_from_platform.Inverse();
  const Eigen::Matrix3d rotation = platform_from_base.rotation.toRotationMatrix();
  return hexapod.platform_joints_in_platform -
         ((rotation * hexapod.base_joints_in_base).colwise() + platform_from_base.translation);
}

// Levenberg-Marquardt on lengths(pose) = lengths. Rotations are counted in arc length at the joints
// so that all six unknowns are metres and the damping treats them alike.
class Solver {
 public:
  Solver(const HexapodGeometry& hexapod, const LegLengths& lengths)
      : hexapod_(hexapod), lengths_(lengths), scale_(lengths.cwiseAbs().maxCoeff()) {
    const Matrix36d& joints = hexapod.platform_joints_in_platform;
    const Eigen::Vector3d centre = joints.rowwise().mean();
    const double radius = std::sqrt((joints.colwise() - centre).squaredNorm() / kNumLegs);
    unit_ << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1.0 / radius);
    platform_centre_ = centre;
    base_centre_ = hexapod.base_joints_in_base.rowwise().mean();
    const Matrix36d spread = hexapod.base_joints_in_base.colwise() - base_centre_;
    const Eigen::Matrix3d inertia = spread * spread.transpose();
    base_normal_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors().col(0);
  }

  struct State {
    Pose3d pose;
    LegLengths misfit;  // lengths at the pose minus those asked for
    Matrix6d jacobian;  // scaled
  };

  State At(const Pose3d& pose) const {
    return {pose,
            InverseKinematics(hexapod_, pose) - lengths_,
            LegJacobian(hexapod_, pose) * unit_.asDiagonal()};
  }

  bool Converged(const State& state) const {
    return state.misfit.cwiseAbs().maxCoeff() <= kTolerance * scale_;
  }

  // Volume spanned by the legs' screws: it changes sign where the legs lose hold of the platform.
  // A hexapod cannot move through such a pose, so beyond it lies another assembly.
  static double Hold(const State& state) { return state.jacobian.determinant(); }

  // Height of the platform's joints over the plane of the base joints, either sign. Flat plates
  // have a mirror image below the base for every pose above it.
  double Height(const State& state) const {
    return base_normal_.dot(state.pose * platform_centre_ - base_centre_);
  }

  // Steps to the other side of the base are refused; with same_assembly, those that lose hold too.
  int Run(State* state, bool same_assembly) const {
    const double height = Height(*state), hold = Hold(*state);
    const auto stays = [&](const State& next) {
      return Height(next) * height >= 0.0 && (!same_assembly || Hold(next) * hold >= 0.0);
    };
    double damping = 1e-3;
    int iteration = 0;
    while (!Converged(*state) && iteration < kMaxIterations) {
      ++iteration;
      const Vector6d step = Step(*state, damping);
      bool accepted = step.allFinite() && step.tail<3>().norm() <= kLargestTurn &&
                      step.head<3>().norm() <= kLargestShift * scale_;
      if (accepted) {
        const State next = At(Plus(state->pose, step));
        accepted = next.misfit.norm() < state->misfit.norm() && stays(next);
        if (accepted) *state = next;
      }
      damping = accepted ? std::max(0.1 * damping, 1e-9) : 4.0 * damping;
    }
    return iteration;
  }

 private:
  // The damping is a fraction of the misfit, so it fades at the solution and the end is quadratic.
  Vector6d Step(const State& state, double damping) const {
    const double lambda = damping * state.misfit.norm() / scale_;
    Eigen::Matrix<double, 12, 6> a;
    a << state.jacobian, std::sqrt(lambda) * Matrix6d::Identity();
    Eigen::Matrix<double, 12, 1> b;
    b << -state.misfit, Vector6d::Zero();
    return unit_.cwiseProduct(a.householderQr().solve(b));
  }

  const HexapodGeometry& hexapod_;
  const LegLengths& lengths_;
  double scale_;
  Eigen::Vector3d platform_centre_, base_centre_, base_normal_;
  Vector6d unit_;  // m or rad of each unknown per m
};

// The largest misfits in words; legs that miss by less than half of it are left out.
std::string DescribeMisfit(const LegLengths& misfit) {
  if (!misfit.allFinite()) return "the leg lengths are not finite numbers";
  std::array<int, kNumLegs> legs;
  std::iota(legs.begin(), legs.end(), 0);
  std::stable_sort(legs.begin(), legs.end(), [&](int a, int b) {
    return std::abs(misfit[a]) > std::abs(misfit[b]);
  });
  std::string text =
      "no pose on this side of the base has these leg lengths; at the nearest one found ";
  for (const int leg : legs) {
    if (2.0 * std::abs(misfit[leg]) < std::abs(misfit[legs[0]])) break;
    if (leg != legs[0]) text += ", ";
    text += fmt::format("leg {} would be {:.4g} mm {}",
                        leg + 1,
                        1e3 * std::abs(misfit[leg]),
                        misfit[leg] > 0.0 ? "longer" : "shorter");
  }
  return text;
}

// Axes of the platform parallel to those of the base, unless turning it brings its joints clearly
// nearer to theirs of the base: frames of the two plates need not agree. Shapes: centred joints.
Eigen::Matrix3d LevelRotation(const Matrix36d& base, const Matrix36d& platform) {
  const Eigen::Matrix3d correlation = base * platform.transpose();
  const Eigen::Matrix3d nearest = NearestRotation(correlation);
  const double gain = nearest.cwiseProduct(correlation).sum() - correlation.trace();
  return gain > 0.25 * base.norm() * platform.norm() ? nearest : Eigen::Matrix3d::Identity();
}

}  // namespace

LegLengths InverseKinematics(const HexapodGeometry& hexapod, const Pose3d& base_from_platform) {
  return LegsInPlatform(hexapod, base_from_platform).colwise().norm().transpose();
}

Matrix6d LegJacobian(const HexapodGeometry& hexapod, const Pose3d& base_from_platform) {
  const Matrix36d legs = LegsInPlatform(hexapod, base_from_platform);
  Matrix6d jacobian;
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d unit = legs.col(i).normalized();
    const Eigen::Vector3d joint = hexapod.platform_joints_in_platform.col(i);
    jacobian.row(i) << unit.transpose(), joint.cross(unit).transpose();
  }
  return jacobian;
}

Pose3d NeutralPose(const HexapodGeometry& hexapod, const LegLengths& lengths) {
  if (hexapod.home) return *hexapod.home;
  const Eigen::Vector3d base_centre = hexapod.base_joints_in_base.rowwise().mean();
  const Eigen::Vector3d platform_centre = hexapod.platform_joints_in_platform.rowwise().mean();
  const Matrix36d base = hexapod.base_joints_in_base.colwise() - base_centre;
  const Matrix36d platform = hexapod.platform_joints_in_platform.colwise() - platform_centre;
  const Eigen::Matrix3d rotation = LevelRotation(base, platform);
  // Offsets sum to zero, so the mean squared length at height h is theirs plus h^2.
  const Matrix36d offsets = rotation * platform - base;
  const double height_squared = (lengths.squaredNorm() - offsets.squaredNorm()) / kNumLegs;
  const double low = 0.1 * lengths.cwiseAbs().mean();
  const double height = height_squared > low * low ? std::sqrt(height_squared) : low;
  return MakePose(rotation,
                  base_centre - rotation * platform_centre + height * Eigen::Vector3d::UnitZ());
}

ForwardKinematicsResult ForwardKinematics(const HexapodGeometry& hexapod,
                                          const LegLengths& lengths,
                                          const Pose3d& start) {
  const Solver solver(hexapod, lengths);
  Solver::State state = solver.At(start);
  ForwardKinematicsResult result;
  result.iterations = solver.Run(&state, true);
  // The start may itself lie beyond a singular pose: then any assembly on its side will do.
  if (!solver.Converged(state)) {
    Solver::State second = solver.At(start);
    result.iterations += solver.Run(&second, false);
    if (second.misfit.norm() < state.misfit.norm()) state = second;
  }
  result.converged = solver.Converged(state);
  result.base_from_platform = state.pose;
  result.largest_misfit = state.misfit.cwiseAbs().maxCoeff();
  if (!result.converged) result.message = DescribeMisfit(state.misfit);
  return result;
}

}  // namespace hexcal
