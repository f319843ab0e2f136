// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/family_wise.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hexcal {
namespace {

constexpr int kChunk = 128;  // draws at a time: their products stay in the cache

// -log10 of 1 - (1 - p)^tests.
double Sidak(double minus_log10_p, double tests) {
  if (minus_log10_p > 12.0) return std::max(0.0, minus_log10_p - std::log10(tests));
  const double p = std::pow(10.0, -minus_log10_p);
  return -std::log10(std::max(-std::expm1(tests * std::log1p(-std::min(p, 1.0 - 1e-16))), 1e-300));
}

}  // namespace

FamilyWise::FamilyWise(const Scorer& scorer, int draws, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::VectorXd> columns;
  for (int done = 0; done < draws; done += kChunk) {
    Eigen::MatrixXd noise(scorer.rows(), std::min(kChunk, draws - done));
    for (double& value : noise.reshaped()) value = normal(generator);
    const Eigen::MatrixXd maxima = scorer.FamilyMaxima(std::move(noise));
    for (Eigen::Index b = 0; b < maxima.cols(); ++b) columns.emplace_back(maxima.col(b));
  }
  const Eigen::Index families = columns.front().size();
  for (Eigen::Index f = 0; f < families; ++f) {
    std::vector<double> of_family;
    for (const Eigen::VectorXd& column : columns) of_family.push_back(column[f]);
    std::nth_element(of_family.begin(), of_family.begin() + draws / 2, of_family.end());
    // The number of independent tests whose smallest p has this median.
    const double median_p = std::pow(10.0, -of_family[draws / 2]);
    tests_.push_back(median_p < 1.0 ? std::max(1.0, -M_LN2 / std::log1p(-median_p)) : 1.0);
  }
  for (const Eigen::VectorXd& column : columns) {
    double best = 0.0;
    for (Eigen::Index f = 0; f < families; ++f)
      best = std::max(best, Paid(static_cast<int>(f), column[f]));
    best_.push_back(best);
  }
  std::sort(best_.begin(), best_.end());
}

double FamilyWise::Paid(int family, double minus_log10_p) const {
  return Sidak(minus_log10_p, tests_[family]);
}

double FamilyWise::PValue(double paid) const {
  const auto beyond = best_.end() - std::lower_bound(best_.begin(), best_.end(), paid);
  const double draws = static_cast<double>(best_.size());
  const double counted = (static_cast<double>(beyond) + 1.0) / (draws + 1.0);
  if (beyond > 0) return counted;
  const double bound = std::pow(10.0, -Sidak(paid, static_cast<double>(tests_.size())));
  return std::min(counted, bound);
}

}  // namespace hexcal
