// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/intervals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/normal_matrix.h"
#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kProbability = 0.95;
constexpr double kUpper = 0.5 * (1.0 + kProbability);
constexpr int kDof = 12;
// Beyond this t is the normal distribution to all digits that matter.
constexpr double kMany = 1e7;

double NormalOrT(double dof) { return StudentTQuantile(kUpper, std::min(dof, kMany)); }

// Satterthwaite's, of a number that is a mix of the 12.
double DegreesOfFreedom(const Intervals& intervals,
                        const Matrix12d& covariance,
                        const Vector12d& weights) {
  if (intervals.slopes.empty()) return intervals.degrees_of_freedom[0];
  const auto n = static_cast<Eigen::Index>(intervals.slopes.size());
  Eigen::VectorXd slope(n);
  for (Eigen::Index k = 0; k < n; ++k) slope[k] = weights.dot(intervals.slopes[k] * weights);
  const double variance = slope.dot(intervals.spread * slope);
  const double of_number = weights.dot(covariance * weights);
  return variance > 0 ? 2.0 * of_number * of_number / variance
                      : std::numeric_limits<double>::infinity();
}

Intervals FromStudentAndFisher(const Matrix12d& covariance, double dof, double ellipsoid) {
  Intervals intervals;
  intervals.degrees_of_freedom.setConstant(dof);
  intervals.half_width = NormalOrT(dof) * covariance.diagonal().cwiseSqrt();
  intervals.ellipsoid = ellipsoid;
  intervals.widened = covariance;
  return intervals;
}

// What the components' variances do to the covariance.
class KenwardRoger {
 public:
  KenwardRoger(const Matrix12d& covariance,
               const std::vector<VarianceComponent>& components,
               const Variances& variances)
      : covariance_(covariance),
        components_(components),
        v_(variances.values),
        spread_(InverseOfNormal(variances.information)) {
    for (std::size_t k = 0; k < components.size(); ++k)
      slopes_.push_back(Slope(static_cast<Eigen::Index>(k)));
  }

  Intervals Run() const {
    Intervals intervals;
    intervals.widened = Widened();
    intervals.slopes = slopes_;
    intervals.spread = spread_;
    for (int i = 0; i < kDof; ++i) {
      const NumberInterval one = IntervalOf(intervals, covariance_, Vector12d::Unit(i));
      intervals.degrees_of_freedom[i] = one.degrees_of_freedom;
      intervals.half_width[i] = one.half_width;
    }
    intervals.ellipsoid = Ellipsoid(intervals.widened);
    return intervals;
  }

 private:
  // d covariance / d v_k = covariance N_k covariance / v_k^2.
  Matrix12d Slope(Eigen::Index k) const {
    return covariance_ * components_[k].normal * covariance_ / (v_[k] * v_[k]);
  }

  // covariance + 2 Lambda, their Eq. (3); the covariance of the data is linear in the variances.
  Matrix12d Widened() const {
    Matrix12d lambda = Matrix12d::Zero();
    const Eigen::Index n = v_.size();
    for (Eigen::Index j = 0; j < n; ++j) {
      lambda += spread_(j, j) / v_[j] * slopes_[j];
      for (Eigen::Index k = 0; k < n; ++k)
        lambda -=
            spread_(j, k) * slopes_[j] * components_[k].normal * covariance_ / (v_[k] * v_[k]);
    }
    return covariance_ + lambda + lambda.transpose();
  }

  // Their scaled F statistic of all 12; its k d' widened^-1 d / 12 ~ F(12, m) turned into a limit
  // on d' covariance^-1 d.
  double Ellipsoid(const Matrix12d& widened) const {
    double a1 = 0.0, a2 = 0.0;
    const Eigen::Index n = v_.size();
    std::vector<Matrix12d> shares;  // N_k covariance / v_k^2
    for (Eigen::Index k = 0; k < n; ++k)
      shares.push_back(components_[k].normal * covariance_ / (v_[k] * v_[k]));
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index k = 0; k < n; ++k) {
        a1 += spread_(j, k) * shares[j].trace() * shares[k].trace();
        a2 += spread_(j, k) * (shares[j] * shares[k]).trace();
      }
    const double l = kDof;
    const double b = (a1 + 6.0 * a2) / (2.0 * l);
    const double g = ((l + 1.0) * a1 - (l + 4.0) * a2) / ((l + 2.0) * a2);
    const double d = 3.0 * l + 2.0 * (1.0 - g);
    const double c1 = g / d, c2 = (l - g) / d, c3 = (l + 2.0 - g) / d;
    const double mean = 1.0 / (1.0 - a2 / l);
    const double variance = 2.0 / l * (1.0 + c1 * b) / (std::pow(1.0 - c2 * b, 2) * (1.0 - c3 * b));
    const double ratio = variance / (2.0 * mean * mean);
    // With many poses the ratio is that of chi-square but for rounding.
    const double excess = l * ratio - 1.0;
    const double m = excess > (l + 2.0) / kMany ? 4.0 + (l + 2.0) / excess : kMany;
    const double scale = m / (mean * (m - 2.0));
    // d' covariance^-1 d over d' widened^-1 d, on the mean of the directions.
    const double widening = (InverseOfNormal(covariance_) * widened).trace() / l;
    return l * FisherFQuantile(kProbability, l, m) / scale * widening;
  }

  const Matrix12d& covariance_;
  const std::vector<VarianceComponent>& components_;
  const Eigen::VectorXd& v_;
  Eigen::MatrixXd spread_;  // covariance of the variances
  std::vector<Matrix12d> slopes_;
};

}  // namespace

NumberInterval IntervalOf(const Intervals& intervals,
                          const Matrix12d& covariance,
                          const Vector12d& weights) {
  const double dof = DegreesOfFreedom(intervals, covariance, weights);
  if (!(dof > 0.0)) return {std::numeric_limits<double>::quiet_NaN(), dof};
  return {NormalOrT(dof) * std::sqrt(std::max(weights.dot(intervals.widened * weights), 0.0)), dof};
}

Intervals IntervalsOfKnownNoise(const Matrix12d& covariance) {
  return FromStudentAndFisher(
      covariance, std::numeric_limits<double>::infinity(), ChiSquareQuantile(kProbability, kDof));
}

Intervals IntervalsOfScaledNoise(const Matrix12d& covariance, double degrees_of_freedom) {
  return FromStudentAndFisher(
      covariance,
      degrees_of_freedom,
      kDof * FisherFQuantile(kProbability, kDof, std::min(degrees_of_freedom, kMany)));
}

Intervals IntervalsOfEstimatedNoise(const Matrix12d& covariance,
                                    const std::vector<VarianceComponent>& components,
                                    const Variances& variances) {
  return KenwardRoger(covariance, components, variances).Run();
}

}  // namespace hexcal
