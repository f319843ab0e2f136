// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/variances.h"

#include <algorithm>
#include <cmath>

#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kRelativeTolerance = 1e-12;
// A component with less than this share of its residuals left free by the fit cannot be estimated.
constexpr double kSmallestFreeShare = 1e-9;

// For every component of variance v, with V = dC/dv and P = C^-1 - C^-1 J N^-1 J' C^-1: y' P V P y
// and tr(P V).
struct Scores {
  Eigen::VectorXd forms, traces;
  Eigen::MatrixXd inverse;  // N^-1
};

Scores Evaluate(const std::vector<VarianceComponent>& components, const Eigen::VectorXd& v) {
  const auto n = static_cast<Eigen::Index>(components.size());
  Eigen::MatrixXd normal = components[0].normal / v[0];
  Eigen::VectorXd gradient = components[0].gradient / v[0];
  for (Eigen::Index k = 1; k < n; ++k) {
    normal += components[k].normal / v[k];
    gradient += components[k].gradient / v[k];
  }
  Scores scores{Eigen::VectorXd(n), Eigen::VectorXd(n), InverseOfNormal(normal)};
  const Eigen::VectorXd step = -scores.inverse * gradient;
  for (Eigen::Index k = 0; k < n; ++k) {
    const VarianceComponent& c = components[k];
    const double left = c.squared_norm + step.dot(2.0 * c.gradient + c.normal * step);
    scores.forms[k] = std::max(left, 0.0) / (v[k] * v[k]);
    scores.traces[k] = (c.rows - scores.inverse.cwiseProduct(c.normal).sum() / v[k]) / v[k];
  }
  return scores;
}

// 1/2 tr(P V_j P V_k).
Eigen::MatrixXd RestrictedInformation(const std::vector<VarianceComponent>& components,
                                      const Eigen::VectorXd& v,
                                      const Eigen::MatrixXd& inverse) {
  const auto n = static_cast<Eigen::Index>(components.size());
  std::vector<Eigen::MatrixXd> shares(n);  // of the parameters, that each component tells
  for (Eigen::Index k = 0; k < n; ++k) shares[k] = inverse * components[k].normal / v[k];
  Eigen::MatrixXd information(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index k = 0; k < n; ++k) {
      double trace = shares[j].cwiseProduct(shares[k].transpose()).sum();
      if (j == k) trace += components[j].rows - 2.0 * shares[j].trace();
      information(j, k) = 0.5 * trace / (v[j] * v[k]);
    }
  return information;
}

}  // namespace

Variances EstimateVariances(const std::vector<VarianceComponent>& components,
                            const Eigen::VectorXd& start,
                            const Eigen::VectorXd& floor) {
  Eigen::VectorXd v = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Scores scores = Evaluate(components, v);
    double change = 0.0;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      if (!(scores.traces[k] * v[k] > kSmallestFreeShare * components[k].rows)) continue;
      const double next = std::max(v[k] * scores.forms[k] / scores.traces[k], floor[k]);
      change = std::max(change, std::abs(next / v[k] - 1.0));
      v[k] = next;
    }
    if (change < kRelativeTolerance) break;
  }
  return {v, RestrictedInformation(components, v, Evaluate(components, v).inverse)};
}

void SetVariances(const Eigen::VectorXd& variances, NormalEquations* equations) {
  equations->normal.setZero();
  equations->gradient.setZero();
  equations->squared_norm = 0.0;
  for (Eigen::Index k = 0; k < variances.size(); ++k) {
    const VarianceComponent& c = equations->components[k];
    equations->normal += c.normal / variances[k];
    equations->gradient += c.gradient / variances[k];
    equations->squared_norm += c.squared_norm / variances[k];
  }
}

}  // namespace hexcal
