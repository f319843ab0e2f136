// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/reading_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "estimator/normal_matrix.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kDof = 3;
// Part of a reading's variance, the least along any direction, that the others must leave to it.
constexpr double kSmallestShare = 1e-3;
// The stated noise is disproved where chance alone leaves as much with this probability.
constexpr double kDisproved = 1e-4;
// What is left of the noise's evidence without one reading, at the least.
constexpr double kSmallestRest = 0.01;

}  // namespace

ReadingFit::ReadingFit(const MarkerObservations& markers,
                       const MarkerSolution& solution,
                       const std::vector<bool>& cut)
    : markers_(markers), data_(markers.data), layout_(data_), solution_(solution), cut_(cut) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& block : solution.blocks) pointers.push_back(block.data());
  unknowns_ = layout_.Unknowns(data_, pointers.data());
}

void ReadingFit::Fit(const std::vector<bool>& out) {
  out_ = out;
  Step();
  tests_.clear();
  unchecked_ = 0;
  for (const Left& one : Residuals()) Test(one);
}

ReadingFit::InPose ReadingFit::At(std::size_t i) const {
  InPose fit;
  fit.rows = LineariseReadings(data_, unknowns_, solution_.sigma, data_.poses[i], cut_[i]);
  const ReadingRows& rows = fit.rows;
  const Eigen::Index own = rows.own.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(own, own);
  Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(own, layout_.size);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(own);
  for (int r = 0; r < rows.readings(); ++r) {
    if (out_[rows.first + r]) continue;
    const auto b = rows.own.middleRows<3>(3 * r);
    normal += b.transpose() * b;
    cross += b.transpose() * rows.globals.middleRows<3>(3 * r);
    gradient += b.transpose() * rows.residual.segment<3>(3 * r);
  }
  for (int k = 0; k < rows.draws; ++k) {
    normal(own - rows.draws + k, own - rows.draws + k) += 1.0;
    gradient[own - rows.draws + k] -= rows.draw[k];
  }
  fit.own_inverse = own > 0 ? InverseOfNormal(normal) : normal;
  fit.own_by_globals = fit.own_inverse * cross;
  fit.reduced = rows.globals - rows.own * fit.own_by_globals;
  fit.own_step = fit.own_inverse * gradient;
  return fit;
}

// One step of all unknowns from the solution, without the readings that are left out.
void ReadingFit::Step() {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(layout_.size, layout_.size);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(layout_.size);
  for (std::size_t i = 0; i < data_.poses.size(); ++i) {
    const InPose fit = At(i);
    const Eigen::VectorXd left = fit.rows.residual - fit.rows.own * fit.own_step;
    for (int r = 0; r < fit.rows.readings(); ++r) {
      if (out_[fit.rows.first + r]) continue;
      const auto globals = fit.rows.globals.middleRows<3>(3 * r);
      normal += globals.transpose() * fit.reduced.middleRows<3>(3 * r);
      gradient += globals.transpose() * left.segment<3>(3 * r);
    }
  }
  inverse_ = InverseOfNormal(Eigen::MatrixXd(0.5 * (normal + normal.transpose())));
  step_ = inverse_ * gradient;
}

std::vector<ReadingFit::Left> ReadingFit::Residuals() {
  std::vector<Left> all;
  double squares = 0.0, freedom = -layout_.size;
  for (std::size_t i = 0; i < data_.poses.size(); ++i) {
    const InPose fit = At(i);
    const ReadingRows& rows = fit.rows;
    const Eigen::VectorXd left = rows.residual - rows.own * fit.own_step - fit.reduced * step_;
    freedom -= static_cast<double>(rows.own.cols() - rows.draws);
    if (rows.draws > 0) freedom -= DrawFreedom(fit);
    for (int r = 0; r < rows.readings(); ++r) {
      const auto own = rows.own.middleRows<3>(3 * r);
      const auto reduced = fit.reduced.middleRows<3>(3 * r);
      if (!out_[rows.first + r]) {
        squares += left.segment<3>(3 * r).squaredNorm();
        freedom += kDof;
      }
      if (markers_.item_of_pose[i] < 0) continue;
      const Eigen::Matrix3d of_fit =
          own * fit.own_inverse * own.transpose() + reduced * inverse_ * reduced.transpose();
      all.push_back(
          {static_cast<int>(i), rows.first + r, left.segment<3>(3 * r), of_fit, rows.sigma[r]});
    }
  }
  SetScale(squares, freedom);
  return all;
}

// The degrees of freedom of the readings that this pose's draw takes: 1 less its variance, each.
double ReadingFit::DrawFreedom(const InPose& at) const {
  const Eigen::Index draws = at.rows.draws;
  const Eigen::MatrixXd moved = at.own_by_globals.bottomRows(draws);
  return static_cast<double>(draws) - at.own_inverse.diagonal().tail(draws).sum() -
         moved.cwiseProduct(moved * inverse_).sum();
}

void ReadingFit::SetScale(double squares, double freedom) {
  freedom_ = freedom;
  const double tail = freedom > 0.0 ? ChiSquareTail(squares, freedom) : 1.0;
  basis_ =
      solution_.sigma_estimated || tail < kDisproved ? NoiseBasis::kScaled : NoiseBasis::kStated;
  scale_ = basis_ == NoiseBasis::kScaled && freedom > 0.0 ? std::sqrt(squares / freedom) : 1.0;
}

// Of a reading in the fit, 1 - of_fit is the covariance of its residual.
void ReadingFit::Test(const Left& one) {
  const bool is_out = out_[one.reading];
  const Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Identity() + (is_out ? 1.0 : -1.0) * one.of_fit;
  if (!(DecomposeSymmetric(covariance).values[0] > kSmallestShare)) {
    ++unchecked_;
    return;
  }
  const Eigen::Matrix3d inverse = covariance.llt().solve(Eigen::Matrix3d::Identity());
  ReadingTest test;
  test.pose = one.pose, test.reading = one.reading;
  test.held_out =
      one.sigma.cwiseProduct(is_out ? one.residual : Eigen::Vector3d(inverse * one.residual));
  test.squared = one.residual.dot(inverse * one.residual) / (scale_ * scale_);
  const Eigen::Vector3d weight = one.sigma.cwiseInverse();
  const Eigen::Matrix3d information =
      weight.asDiagonal() * (is_out ? inverse : covariance) * weight.asDiagonal();
  test.unit = scale_ / std::sqrt(DecomposeSymmetric(information).values[0]);
  test.redundancy = is_out ? 1.0 : 1.0 - one.of_fit.trace() / kDof;
  test.p_value = Tail(is_out, &test.squared);
  tests_.push_back(test);
}

// Studentised by a noise that this reading has no part in.
double ReadingFit::Tail(bool is_out, double* squared) const {
  if (basis_ == NoiseBasis::kStated) return ChiSquareTail(*squared, kDof);
  const double freedom = freedom_ - (is_out ? 0.0 : kDof);
  if (!(freedom > 0.0)) return 1.0;
  if (!is_out) *squared /= std::max(freedom_ - *squared, kSmallestRest * freedom_) / freedom;
  return FisherFTail(*squared / kDof, kDof, freedom);
}

}  // namespace hexcal
