// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/pose_fit.h"

#include <Eigen/Dense>
#include <cmath>

namespace hexcal::hidden {
namespace {

constexpr double kStep = 1e-6;
using TrackerSlope = Eigen::Matrix<double, 24, 6>;

std::vector<HiddenEffect> With(std::vector<HiddenEffect> effects, const Eigen::VectorXd& change) {
  int first = 0;
  for (HiddenEffect& effect : effects) {
    effect.parameters += change.segment(first, effect.parameters.size());
    first += static_cast<int>(effect.parameters.size());
  }
  return effects;
}

Eigen::VectorXd Largest(const std::vector<HiddenEffect>& effects) {
  Eigen::VectorXd largest;
  for (const HiddenEffect& effect : effects) {
    const auto before = largest.size();
    largest.conservativeResize(before + effect.largest.size());
    largest.tail(effect.largest.size()) = effect.largest;
  }
  return largest;
}

// d(reading) / d(base 6, tool 6, parameters).
Eigen::MatrixXd Slope(const Scene& scene,
                      const std::vector<HiddenEffect>& effects,
                      const Row& row) {
  const Eigen::VectorXd largest = Largest(effects);
  Eigen::MatrixXd slope(24, 12 + largest.size());
  const Additions additions = Sum(effects, scene, row);
  // Base and tool stand beside the loops: these are closed once.
  Row there = row;
  there.base_from_platform = TruePlatform(scene, row, additions);
  Additions beside = additions;
  beside.leg.setZero();
  beside.base.setZero();
  beside.platform.setZero();
  beside.platform_twist.setZero();
  for (int k = 0; k < 12; ++k) {
    Reading end[2];
    for (int s = 0; s < 2; ++s) {
      Scene moved = {};
      moved.base_markers = scene.base_markers;
      moved.tool_markers = scene.tool_markers;
      const Six d = (s == 0 ? kStep : -kStep) * Six::Unit(k % 6);
      moved.world_from_base = k < 6 ? Moved(scene.world_from_base, d) : scene.world_from_base;
      moved.platform_from_tool =
          k < 6 ? scene.platform_from_tool : Moved(scene.platform_from_tool, d);
      end[s] = TrueReading(moved, there, beside);
    }
    slope.col(k) = (end[0] - end[1]) / (2 * kStep);
  }
  for (int k = 0; k < largest.size(); ++k) {
    const Eigen::VectorXd d = 1e-3 * largest[k] * Eigen::VectorXd::Unit(largest.size(), k);
    slope.col(12 + k) = (TrueReading(scene, row, Sum(With(effects, d), scene, row)) -
                         TrueReading(scene, row, Sum(With(effects, -d), scene, row))) /
                        (2e-3 * largest[k]);
  }
  return slope;
}

TrackerSlope SlopeByTracker(const Scene& scene, const Row& row, const Additions& additions) {
  Row there = row;
  there.base_from_platform = TruePlatform(scene, row, additions);
  Additions beside = additions;
  beside.leg.setZero();
  beside.base.setZero();
  beside.platform.setZero();
  beside.platform_twist.setZero();
  TrackerSlope slope;
  for (int k = 0; k < 6; ++k) {
    const Six d = kStep * Six::Unit(k);
    Row plus = there, minus = there;
    plus.tracker_from_world = Moved(row.tracker_from_world, d);
    minus.tracker_from_world = Moved(row.tracker_from_world, -d);
    slope.col(k) =
        (TrueReading(scene, plus, beside) - TrueReading(scene, minus, beside)) / (2 * kStep);
  }
  return slope;
}

// The unknowns of all rows: base, tool, parameters, and the tracker's pose where it stands still.
// Where it does not, its pose of each row is taken out of that row's columns and residual.
struct Normal {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd vector;
  double square = 0.0;         // of the residual
  double within_bodies = 0.0;  // of it, what no motion of the two bodies can explain

  explicit Normal(int size)
      : matrix(Eigen::MatrixXd::Zero(size, size)), vector(Eigen::VectorXd::Zero(size)) {}

  // Whitened columns and residual.
  void Add(Eigen::MatrixXd columns, Reading residual, const TrackerSlope& tracker, bool is_static) {
    if (is_static) {
      columns.conservativeResize(24, columns.cols() + 6);
      columns.rightCols<6>() = tracker;
    } else {
      const Eigen::HouseholderQR<TrackerSlope> qr(tracker);
      const Eigen::MatrixXd q = qr.householderQ() * TrackerSlope::Identity();
      columns -= q * (q.transpose() * columns).eval();
      residual -= q * (q.transpose() * residual).eval();
    }
    matrix += columns.transpose() * columns;
    vector += columns.transpose() * residual;
    square += residual.squaredNorm();
    within_bodies += WithinBodies(residual, tracker);
  }

  static double WithinBodies(const Reading& residual, const TrackerSlope& tracker) {
    Eigen::MatrixXd bodies = Eigen::MatrixXd::Zero(24, 12);
    bodies.topLeftCorner<12, 6>() = tracker.topRows<12>();
    bodies.bottomRightCorner<12, 6>() = tracker.bottomRows<12>();
    return (residual - bodies * bodies.colPivHouseholderQr().solve(residual)).squaredNorm();
  }

  // Scaled, so that m and rad do not decide what is singular.
  Eigen::MatrixXd Inverse() const {
    const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    const Eigen::MatrixXd inverse =
        scaled.ldlt().solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols()));
    return scale.asDiagonal() * inverse * scale.asDiagonal();
  }
};

// Whitens by the noise of a row.
class Whitener {
 public:
  Whitener(const Scene& scene, const Row& row, Regime regime)
      : cholesky_(NoiseCovariance(scene, row, regime)) {}
  template <typename M>
  M operator()(const M& columns) const {
    return cholesky_.matrixL().solve(columns);
  }

 private:
  Eigen::LLT<ReadingCovariance> cholesky_;
};

int Unknowns(const Scene& scene, const std::vector<HiddenEffect>& effects) {
  return 12 + static_cast<int>(Largest(effects).size()) + (scene.tracker_is_static ? 6 : 0);
}

// One step of Gauss-Newton; its length in sigmas.
double Improve(const std::vector<Reading>& readings, Fit* fit) {
  Scene& scene = fit->scene;
  const Eigen::VectorXd largest = Largest(fit->effects);
  Normal normal(Unknowns(scene, fit->effects));
  struct Kept {
    Eigen::MatrixXd columns;
    TrackerSlope tracker;
    Reading residual;
    Row* row;
  };
  std::vector<Kept> kept;
  std::size_t next = 0;
  for (Row& row : scene.rows) {
    if (!row.is_measured) continue;
    const Additions additions = Sum(fit->effects, scene, row);
    const Whitener whiten(scene, row, Regime::kWhite);
    kept.push_back({whiten(Slope(scene, fit->effects, row)),
                    whiten(SlopeByTracker(scene, row, additions)),
                    whiten(Reading(readings[next++] - TrueReading(scene, row, additions))),
                    &row});
    const Kept& k = kept.back();
    normal.Add(k.columns, k.residual, k.tracker, scene.tracker_is_static);
  }
  int first = 12;
  for (const HiddenEffect& effect : fit->effects)
    for (int j = 0; j < effect.parameters.size(); ++j, ++first) {
      normal.matrix(first, first) += 1.0 / (effect.largest[j] * effect.largest[j]);
      normal.vector[first] -= effect.parameters[j] / (effect.largest[j] * effect.largest[j]);
    }
  fit->chi_square = normal.square;
  fit->pose_chi_square = normal.square - normal.within_bodies;
  fit->covariance = normal.Inverse();
  const Eigen::VectorXd step = fit->covariance * normal.vector;
  scene.world_from_base = Moved(scene.world_from_base, step.head<6>());
  scene.platform_from_tool = Moved(scene.platform_from_tool, step.segment<6>(6));
  fit->effects = With(fit->effects, step.segment(12, largest.size()));
  for (const Kept& k : kept) {
    const Six turn =
        scene.tracker_is_static
            ? Six(step.tail<6>())
            : Six(k.tracker.colPivHouseholderQr().solve(k.residual - k.columns * step));
    k.row->tracker_from_world = Moved(k.row->tracker_from_world, turn);
  }
  return std::sqrt(step.dot(normal.matrix * step));
}

}  // namespace

Fit FitMounts(const Scene& scene,
              const std::vector<HiddenEffect>& effects,
              const std::vector<Reading>& readings) {
  Fit fit;
  fit.scene = scene;
  fit.effects = effects;
  fit.poses = scene.MeasuredRows();
  // One more step than needed, for the sums at the solution.
  for (int iteration = 0; iteration < 12; ++iteration)
    if (Improve(readings, &fit) < 1e-4) break;
  return fit;
}

double Snr(const Scene& scene,
           const std::vector<HiddenEffect>& effects,
           const std::vector<HiddenEffect>& others,
           Regime regime,
           Level level) {
  Normal normal(Unknowns(scene, {}));
  std::vector<HiddenEffect> all = others;
  all.insert(all.end(), effects.begin(), effects.end());
  for (const Row& row : scene.rows) {
    if (!row.is_measured) continue;
    const Additions additions = Sum(others, scene, row);
    const Whitener whiten(scene, row, regime);
    const Reading signal =
        TrueReading(scene, row, Sum(all, scene, row)) - TrueReading(scene, row, additions);
    normal.Add(whiten(Slope(scene, {}, row)),
               whiten(signal),
               whiten(SlopeByTracker(scene, row, additions)),
               scene.tracker_is_static);
  }
  double left = normal.square - normal.vector.dot(normal.Inverse() * normal.vector);
  if (level == Level::kPoses) left -= normal.within_bodies;
  return std::sqrt(std::max(left, 0.0));
}

bool ScaleTo(double snr, const Scene& scene, Regime regime, Level level, HiddenEffect* effect) {
  effect->parameters *=
      0.1 / effect->parameters.cwiseAbs().cwiseQuotient(effect->largest).maxCoeff();
  for (int pass = 0; pass < 3; ++pass) {
    const double now = Snr(scene, {*effect}, {}, regime, level);
    if (!(now > 1e-9)) return false;
    effect->parameters *= snr / now;
    if (!((effect->parameters.cwiseAbs() - effect->largest).maxCoeff() <= 0)) return false;
  }
  return true;
}

double HeldoutRms(const Fit& fit, const Scene& scene, const std::vector<HiddenEffect>& truth) {
  double square = 0.0;
  int rows = 0;
  for (const Row& row : scene.rows) {
    if (row.is_measured) continue;
    const Motion predicted = TrueTool(fit.scene, row, Sum(fit.effects, fit.scene, row));
    const Motion real = TrueTool(scene, row, Sum(truth, scene, row));
    square += (predicted.shift - real.shift).squaredNorm();
    ++rows;
  }
  return std::sqrt(square / rows);
}

double NoiseFloor(const Scene& scene) {
  const Fit fit = FitMounts(scene, {}, TrueReadings(scene, {}));
  double square = 0.0;
  int rows = 0;
  for (const Row& row : scene.rows) {
    if (row.is_measured) continue;
    Eigen::Matrix<double, 3, 12> slope;
    for (int k = 0; k < 12; ++k) {
      Scene moved = {};
      moved.world_from_base = scene.world_from_base;
      moved.platform_from_tool = scene.platform_from_tool;
      Motion* mount = k < 6 ? &moved.world_from_base : &moved.platform_from_tool;
      *mount = Moved(*mount, kStep * Six::Unit(k % 6));
      slope.col(k) = (TrueTool(moved, row, {}).shift - TrueTool(scene, row, {}).shift) / kStep;
    }
    square += (slope * fit.covariance.topLeftCorner(12, 12) * slope.transpose()).trace();
    ++rows;
  }
  return std::sqrt(square / rows);
}

}  // namespace hexcal::hidden
