// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/axis_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "estimator/quantiles.h"
#include "geometry/align_points.h"

namespace hexcal {
namespace {

using Eigen::Vector3d;

constexpr double kChance = 1e-3;   // with which axes are called different that are not
constexpr double kBadBody = 1e-3;  // share of clean datasets of which a body is left out
constexpr int kMostTrims = 5;
constexpr std::size_t kMostPoses = 1000;  // taken evenly; more tell the ratios no better than asked
constexpr int kMaxIterations = 500;
constexpr double kSettled = 1e-10;
// An axis of which less than this share of the rows is left over is not told.
constexpr double kLeastFree = 1e-6;
constexpr double kCollinear = 1e-3;

// Sums over the readings of one body in one pose, by axis: everything at another noise follows.
struct BodySums {
  std::array<Matrix6d, 3> normal;
  std::array<Vector6d, 3> gradient;
  Vector3d squares = Vector3d::Zero();
  double rows = 0.0;  // of each axis

  BodySums() {
    normal.fill(Matrix6d::Zero());
    gradient.fill(Vector6d::Zero());
  }
};

// The restricted likelihood of all bodies at these variances.
struct Likelihood {
  Vector3d left = Vector3d::Zero(), free = Vector3d::Zero();  // whitened squares, of so many
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();      // by the logarithms
  double logarithm = 0.0;
  std::vector<double> of_bodies;  // whitened squares
};

// d(p_in_tracker) by a small motion about the body's centroid, axes of the tracker: 1, -[p]x.
Eigen::Matrix<double, 3, 6> MotionJacobian(const Vector3d& p) {
  Eigen::Matrix<double, 3, 6> j;
  j << Eigen::Matrix3d::Identity(), -Skew(p);
  return j;
}

std::optional<BodySums> SumsOf(const MarkerData& data,
                               const MarkerShape& body,
                               int first,
                               int end) {
  const int n = end - first;
  if (body.is_centroid || n < 3) return std::nullopt;
  Eigen::Matrix3Xd seen(3, n), known(3, n);
  for (int i = 0; i < n; ++i) {
    seen.col(i) = data.readings[first + i].p_in_tracker;
    known.col(i) = body.p_in_body.col(data.readings[first + i].marker);
  }
  const double size = (known.colwise() - known.rowwise().mean().eval()).norm();
  if (!(PlanarSpread(known) > kCollinear * size)) return std::nullopt;
  const Pose3d tracker_from_body = AlignPoints(seen, known);
  const Vector3d centroid = seen.rowwise().mean();
  BodySums sums;
  sums.rows = n;
  for (int i = 0; i < n; ++i) {
    const Vector3d p = tracker_from_body * Vector3d(known.col(i));
    const Vector3d e = seen.col(i) - p;
    // Lengths by the body's size, so that all columns are about 1.
    Eigen::Matrix<double, 3, 6> j = MotionJacobian(Vector3d((p - centroid) / size));
    const double frames = data.readings[first + i].frames;
    for (int a = 0; a < 3; ++a) {
      sums.normal[a] += frames * j.row(a).transpose() * j.row(a);
      sums.gradient[a] -= frames * e[a] * j.row(a).transpose();
      sums.squares[a] += frames * e[a] * e[a];
    }
  }
  return sums;
}

std::vector<BodySums> BodiesOf(const MarkerData& data) {
  std::vector<BodySums> bodies;
  const std::size_t step = (data.poses.size() + kMostPoses - 1) / kMostPoses;
  for (std::size_t i = 0; i < data.poses.size(); i += step) {
    const MarkerPose& pose = data.poses[i];
    for (const auto& sums : {SumsOf(data, data.bodies[0], pose.first_base, pose.first_tool),
                             SumsOf(data, data.bodies[1], pose.first_tool, pose.end)})
      if (sums) bodies.push_back(*sums);
  }
  return bodies;
}

Likelihood Evaluate(const std::vector<BodySums>& bodies,
                    const PureError& frames,
                    const Vector3d& variance) {
  Likelihood all;
  for (const BodySums& body : bodies) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    for (int a = 0; a < 3; ++a) {
      normal += body.normal[a] / variance[a];
      gradient += body.gradient[a] / variance[a];
    }
    const Eigen::LLT<Matrix6d> llt(normal);
    const Vector6d step = -llt.solve(gradient);
    std::array<Matrix6d, 3> shares;  // of the motion, that each axis tells
    double squares = 0.0;
    for (int a = 0; a < 3; ++a) {
      shares[a] = llt.solve(body.normal[a]) / variance[a];
      const double left =
          body.squares[a] + step.dot(2.0 * body.gradient[a] + body.normal[a] * step);
      squares += std::max(left, 0.0) / variance[a];
      all.left[a] += std::max(left, 0.0) / variance[a];
      all.free[a] += body.rows - shares[a].trace();
    }
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        all.information(j, k) += 0.5 * (shares[j].cwiseProduct(shares[k].transpose()).sum() +
                                        (j == k ? body.rows - 2.0 * shares[j].trace() : 0.0));
    all.logarithm -= llt.matrixLLT().diagonal().array().log().sum() +
                     0.5 * (squares + body.rows * variance.array().log().sum());
    all.of_bodies.push_back(squares);
  }
  const double freedom = frames.degrees_of_freedom;
  const Vector3d scatter = frames.squares.cwiseQuotient(variance);
  all.left += scatter;
  all.free.array() += freedom;
  all.information.diagonal().array() += 0.5 * freedom;
  all.logarithm -= 0.5 * (scatter.sum() + freedom * variance.array().log().sum());
  return all;
}

// Where what is left over is what is expected, axis by axis; nothing where one is not told.
std::optional<Vector3d> Estimated(const std::vector<BodySums>& bodies, const PureError& frames) {
  double rows = frames.degrees_of_freedom;
  Vector3d squares = frames.squares;
  for (const BodySums& body : bodies) {
    rows += body.rows;
    squares += body.squares;
  }
  if (!(squares.minCoeff() > 0.0)) return std::nullopt;
  Vector3d variance = Vector3d::Constant(squares.mean() / rows);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Likelihood at = Evaluate(bodies, frames, variance);
    if (!(at.free.minCoeff() > kLeastFree * rows) || !(at.left.minCoeff() > 0.0))
      return std::nullopt;
    const Vector3d factor = at.left.cwiseQuotient(at.free);
    variance = variance.cwiseProduct(factor);
    if ((factor.array() - 1.0).abs().maxCoeff() < kSettled) break;
  }
  return variance;
}

// Those that their own shape contradicts at this noise go; whether there were any.
bool Trim(const Vector3d& variance, const PureError& frames, std::vector<BodySums>* bodies) {
  const Likelihood at = Evaluate(*bodies, frames, variance);
  std::vector<BodySums> kept;
  const double share = 1.0 - kBadBody / static_cast<double>(bodies->size());
  for (std::size_t i = 0; i < bodies->size(); ++i)
    if (at.of_bodies[i] <= ChiSquareQuantile(share, 3.0 * (*bodies)[i].rows - 6.0))
      kept.push_back((*bodies)[i]);
  const bool trimmed = kept.size() < bodies->size();
  *bodies = std::move(kept);
  return trimmed;
}

}  // namespace

Vector3d AxisNoise::DegreesOfFreedom() const { return 2.0 * spread.diagonal().cwiseInverse(); }

bool AxisNoise::AxesDiffer() const {
  return likelihood_ratio > ChiSquareQuantile(1.0 - kChance, 2.0);
}

std::optional<AxisNoise> NoiseWithinBodies(const MarkerObservations& markers) {
  std::vector<BodySums> bodies = BodiesOf(markers.data);
  std::optional<Vector3d> variance = Estimated(bodies, markers.pure_error);
  for (int k = 0; variance && k < kMostTrims; ++k) {
    if (!Trim(*variance, markers.pure_error, &bodies)) break;
    variance = Estimated(bodies, markers.pure_error);
  }
  if (!variance) return std::nullopt;
  const Likelihood at = Evaluate(bodies, markers.pure_error, *variance);
  const Eigen::LLT<Eigen::Matrix3d> information(at.information);
  if (information.info() != Eigen::Success) return std::nullopt;
  // Alike, what is left over tells the one variance without a search.
  const Likelihood unit = Evaluate(bodies, markers.pure_error, Vector3d::Ones());
  const double common = unit.left.sum() / unit.free.sum();
  const Likelihood alike = Evaluate(bodies, markers.pure_error, Vector3d::Constant(common));
  AxisNoise noise;
  noise.sigma = variance->cwiseSqrt();
  noise.spread = information.solve(Eigen::Matrix3d::Identity());
  noise.likelihood_ratio = 2.0 * (at.logarithm - alike.logarithm);
  return noise;
}

}  // namespace hexcal
