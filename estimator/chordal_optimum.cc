// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/chordal_optimum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

using Vector6 = Vector6d;
constexpr int kRotations = ChordalCost::kRotations;
constexpr int kTranslations = 6;
constexpr int kReduced = kRotations + 1;
// |w|^2 of every point: two rotations and the 1.
constexpr double kSquaredLength = 7.0;

constexpr int kMaxSteps = 200;
constexpr int kMaxHalvings = 40;
// Curvatures below this part of the largest are taken as this.
constexpr double kFlat = 1e-12;
// Of the translations' normal matrix: rotations that differ by less than a microradian tell
// nothing.
constexpr double kOpen = 1e-12;
// Roundings in a sum of this size, and the part of the cost that is as good as nothing.
constexpr double kRoundings = 16.0;
constexpr double kNothing = 1e-6;
// A step below this, rad, is rounding.
constexpr double kArrived = 1e-13;

// The form with the translations eliminated, and how to get them back: [t, c] = back w.
struct Reduced {
  Eigen::MatrixXd form, back;
  bool translations_determined = true;
};

Reduced Eliminate(const Eigen::MatrixXd& form) {
  const Eigenvalues eigen = DecomposeSymmetric(form.block<6, 6>(kRotations, kRotations));
  Reduced reduced;
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(kTranslations, kTranslations);
  for (int k = 0; k < kTranslations; ++k)
    if (eigen.values[k] > kOpen * eigen.values[kTranslations - 1])
      inverse += eigen.vectors.col(k) * eigen.vectors.col(k).transpose() / eigen.values[k];
    else
      reduced.translations_determined = false;
  Eigen::MatrixXd kept(kReduced, kReduced), coupling(kTranslations, kReduced);
  kept << form.topLeftCorner(kRotations, kRotations), form.topRightCorner(kRotations, 1),
      form.bottomLeftCorner(1, kRotations), form.bottomRightCorner(1, 1);
  coupling << form.block(kRotations, 0, kTranslations, kRotations),
      form.block(kRotations, kReduced - 1 + kTranslations, kTranslations, 1);
  reduced.back = -inverse * coupling;
  reduced.form = kept + coupling.transpose() * reduced.back;
  return reduced;
}

struct Rotations {
  Eigen::Matrix3d z, r;

  Eigen::VectorXd Point() const {
    Eigen::VectorXd w(kReduced);
    w << Eigen::Map<const Eigen::VectorXd>(z.data(), 9),
        Eigen::Map<const Eigen::VectorXd>(r.data(), 9), 1.0;
    return w;
  }
  Rotations Turned(const Vector6d& turn) const {
    const Eigen::Vector3d dz = turn.head<3>(), dr = turn.tail<3>();
    return {(Eigen::Quaterniond(z) * Exp(dz)).normalized().toRotationMatrix(),
            (Eigen::Quaterniond(r) * Exp(dr)).normalized().toRotationMatrix()};
  }
  // d Point / d turn, 19 x 6.
  Eigen::MatrixXd Derivative() const {
    Eigen::MatrixXd d = Eigen::MatrixXd::Zero(kReduced, 6);
    for (int j = 0; j < 3; ++j) {
      const Eigen::Matrix3d skew = Skew(Eigen::Vector3d(Eigen::Vector3d::Unit(j)));
      d.block<3, 3>(3 * j, 0) = -z * skew;
      d.block<3, 3>(9 + 3 * j, 3) = -r * skew;
    }
    return d;
  }
};

// The rotation's multiplier matrix; symmetric where the point is stationary.
Eigen::Matrix3d Multiplier(const Eigen::Matrix3d& rotation, const double* gradient) {
  return rotation.transpose() * Eigen::Map<const Eigen::Matrix3d>(gradient);
}

class Descent {
 public:
  Descent(const Reduced& reduced, const Rotations& start)
      : reduced_(reduced), at_(start), value_(Value(start)) {
    rounding_ = kRoundings * std::numeric_limits<double>::epsilon() * reduced.form.trace();
  }

  // Steps until only rounding is left of them. false: it did not get there.
  bool Run() {
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kMaxSteps; ++k) {
      const Vector6d step = Step();
      const double size = step.cwiseAbs().maxCoeff();
      if (size < kArrived || (size < 1e-9 && !(size < 0.5 * last))) return true;
      if (!Move(step)) return size < 1e-7;
      last = size;
    }
    return false;
  }

  const Rotations& at() const { return at_; }
  double value() const { return value_; }
  double rounding() const { return rounding_; }

 private:
  double Value(const Rotations& at) const {
    const Eigen::VectorXd w = at.Point();
    return w.dot(reduced_.form * w);
  }

  // Newton's, downhill along negative curvature too.
  Vector6d Step() const {
    const Eigen::VectorXd g = reduced_.form * at_.Point();
    const Eigen::MatrixXd d = at_.Derivative();
    Matrix6d hessian = d.transpose() * reduced_.form * d;
    // The second order of the exponential: tr(G' Z [turn]x^2) / 2.
    const auto curve = [&hessian](int first, const Eigen::Matrix3d& m) {
      hessian.block<3, 3>(first, first) +=
          0.5 * (m + m.transpose()) - m.trace() * Eigen::Matrix3d::Identity();
    };
    curve(0, Multiplier(at_.z, g.data()));
    curve(3, Multiplier(at_.r, g.data() + 9));
    const Vector6d gradient = d.transpose() * g;
    const Eigenvalues eigen = DecomposeSymmetric(hessian);
    const double largest = eigen.values.cwiseAbs().maxCoeff();
    Vector6d step = Vector6d::Zero();
    for (int k = 0; k < 6; ++k) {
      const Vector6d direction = eigen.vectors.col(k);
      step -= direction * direction.dot(gradient) /
              std::max(std::abs(eigen.values[k]), kFlat * largest);
    }
    const double size = step.norm();
    return size > 0.5 ? Vector6d(step * (0.5 / size)) : step;
  }

  bool Move(Vector6d step) {
    for (int k = 0; k < kMaxHalvings; ++k, step *= 0.5) {
      const Rotations next = at_.Turned(step);
      const double value = Value(next);
      if (!(value <= value_ + rounding_)) continue;
      at_ = next;
      value_ = value;
      return true;
    }
    return false;
  }

  const Reduced& reduced_;
  Rotations at_;
  double value_;
  double rounding_;
};

// S of the comment on ChordalOptimum, from w and F w.
Eigen::MatrixXd DualMatrix(const Reduced& reduced, const Rotations& at, const Eigen::VectorXd& g) {
  Eigen::MatrixXd s = reduced.form;
  const auto subtract = [&s](int first, const Eigen::Matrix3d& multiplier) {
    const Eigen::Matrix3d symmetric = 0.5 * (multiplier + multiplier.transpose());
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        s.block<3, 3>(first + 3 * i, first + 3 * j).diagonal().array() -= symmetric(i, j);
  };
  subtract(0, Multiplier(at.z, g.data()));
  subtract(9, Multiplier(at.r, g.data() + 9));
  s(kReduced - 1, kReduced - 1) -= g[kReduced - 1];
  return s;
}

// What S proves.
void Judge(const Reduced& reduced, const Rotations& at, double weight, ChordalOptimum* optimum) {
  const Eigen::VectorXd w = at.Point(), g = reduced.form * w;
  const Eigen::MatrixXd s = DualMatrix(reduced, at, g);
  const Eigen::VectorXd unit = w / std::sqrt(kSquaredLength), left = s * unit;
  // S without w's own eigenvalue, which is 0 but for rounding and moves to where it does not count.
  const Eigen::MatrixXd away =
      Eigen::MatrixXd::Identity(kReduced, kReduced) - unit * unit.transpose();
  const double largest = reduced.form.trace();
  const double smallest =
      DecomposeSymmetric(away * s * away + largest * unit * unit.transpose()).values[0];
  // Where w is stationary but for S unit = left: u = a unit + b, b across, has
  //   u' S u >= a^2 unit' left - 2 |a b| |left| + smallest |b|^2.
  const double along = std::abs(unit.dot(left)), across = left.norm();
  const double floor = optimum->rounding;
  const double below =
      smallest > floor ? across * across / smallest : std::max(0.0, -smallest) + across;
  optimum->lower_bound = optimum->cost - kSquaredLength * (along + below);
  optimum->gap = (optimum->cost - optimum->lower_bound) / std::max(optimum->cost, floor);
  optimum->smallest_eigenvalue = smallest / weight;
  optimum->is_unique = reduced.translations_determined && smallest > floor;
  optimum->is_best = optimum->is_stationary &&
                     optimum->cost - optimum->lower_bound <= kNothing * optimum->cost + floor;
}

}  // namespace

ChordalOptimum FindChordalOptimum(const ChordalCost& cost, const BaseAndTool& start) {
  const Reduced reduced = Eliminate(cost.Form());
  Descent descent(reduced,
                  {start.world_from_base.rotation.toRotationMatrix().transpose(),
                   start.platform_from_tool.rotation.toRotationMatrix()});
  ChordalOptimum optimum;
  optimum.is_stationary = descent.Run();
  const Rotations& at = descent.at();
  const Eigen::VectorXd translations = reduced.back * at.Point();
  optimum.mounts = {
      MakePose(at.z.transpose(), at.z.transpose() * cost.BaseShift(at.z, translations.tail<3>())),
      MakePose(at.r, translations.head<3>())};
  optimum.cost = std::max(0.0, descent.value());
  optimum.rounding = descent.rounding();
  Judge(reduced, at, cost.orientation(), &optimum);
  return optimum;
}

}  // namespace hexcal
