// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/align_points.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace hexcal {
namespace {

constexpr int kMaxIterations = 20;
constexpr double kSmallStep = 1e-14;  // rad, and m per metre of the body

// One Gauss-Newton step of the weighted fit: normal matrix, gradient and cost at a_from_b.
struct Normal {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi_square = 0.0;
};

Normal Linearise(const Pose3d& a_from_b,
                 const Eigen::Matrix3Xd& p_in_a,
                 const Eigen::Matrix3Xd& p_in_b,
                 const Eigen::Matrix3Xd& sigma_in_a) {
  const Eigen::Matrix3d rotation = a_from_b.rotation.toRotationMatrix();
  Normal normal;
  for (Eigen::Index k = 0; k < p_in_a.cols(); ++k) {
    const Eigen::Vector3d p = p_in_b.col(k);
    const Eigen::Vector3d weight = sigma_in_a.col(k).cwiseInverse();
    Eigen::Matrix<double, 3, 6> jacobian;
    jacobian << rotation, -rotation * Skew(p);
    jacobian = weight.asDiagonal() * jacobian;
    const Eigen::Vector3d misfit = weight.cwiseProduct(p_in_a.col(k) - a_from_b * p);
    normal.matrix += jacobian.transpose() * jacobian;
    normal.gradient += jacobian.transpose() * misfit;
    normal.chi_square += misfit.squaredNorm();
  }
  return normal;
}

}  // namespace

double PlanarSpread(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 3) return 0.0;
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean().eval();
  // By the eigenvalues of the scatter: half the digits of an SVD, which is enough for a verdict, at
  // a tenth of its time.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> scatter;
  scatter.computeDirect(centred * centred.transpose(), Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(scatter.eigenvalues()[1], 0.0));
}

Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d& u = svd.matrixU();
  const Eigen::Matrix3d& v = svd.matrixV();
  const double sign = u.determinant() * v.determinant() < 0 ? -1.0 : 1.0;
  return u * Eigen::Vector3d(1, 1, sign).asDiagonal() * v.transpose();
}

Pose3d AlignPoints(const Eigen::Matrix3Xd& p_in_a, const Eigen::Matrix3Xd& p_in_b) {
  const Eigen::Vector3d centre_in_a = p_in_a.rowwise().mean();
  const Eigen::Vector3d centre_in_b = p_in_b.rowwise().mean();
  const Eigen::Matrix3d rotation = NearestRotation((p_in_a.colwise() - centre_in_a) *
                                                   (p_in_b.colwise() - centre_in_b).transpose());
  return MakePose(rotation, centre_in_a - rotation * centre_in_b);
}

Alignment AlignPointsWeighted(const Eigen::Matrix3Xd& p_in_a,
                              const Eigen::Matrix3Xd& p_in_b,
                              const Eigen::Matrix3Xd& sigma_in_a) {
  Alignment fit;
  fit.a_from_b = AlignPoints(p_in_a, p_in_b);
  const double size = (p_in_b.colwise() - p_in_b.rowwise().mean().eval()).norm();
  Normal normal = Linearise(fit.a_from_b, p_in_a, p_in_b, sigma_in_a);
  for (int i = 0; i < kMaxIterations; ++i) {
    const Vector6d step = normal.matrix.ldlt().solve(normal.gradient);
    fit.a_from_b = Plus(fit.a_from_b, step);
    normal = Linearise(fit.a_from_b, p_in_a, p_in_b, sigma_in_a);
    if (step.head<3>().norm() <= kSmallStep * size && step.tail<3>().norm() <= kSmallStep) break;
  }
  fit.covariance = normal.matrix.ldlt().solve(Matrix6d::Identity());
  fit.chi_square = normal.chi_square;
  return fit;
}

}  // namespace hexcal
