// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/autocorrelation.h"

#include <cmath>

namespace hexcal {
namespace {

double Product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if (std::isfinite(a[k]) && std::isfinite(b[k])) sum += a[k] * b[k];
  return sum;
}

}  // namespace

Autocorrelation FindAutocorrelation(const std::vector<Eigen::VectorXd>& rows,
                                    std::size_t most_lags) {
  double squares = 0.0;
  Eigen::Index count = 0;
  for (const Eigen::VectorXd& row : rows) {
    squares += Product(row, row);
    count += row.array().isFinite().count();
  }
  Autocorrelation found;
  if (!(squares > 0.0)) return found;
  found.band = 2.0 / std::sqrt(static_cast<double>(count));
  for (std::size_t lag = 1; lag <= most_lags && lag < rows.size(); ++lag) {
    double products = 0.0;
    for (std::size_t i = 0; i + lag < rows.size(); ++i) products += Product(rows[i], rows[i + lag]);
    found.of_lag.push_back(products / squares);
  }
  return found;
}

}  // namespace hexcal
