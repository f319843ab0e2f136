// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/autocorrelation.h"

#include <algorithm>
#include <cmath>

namespace hexcal {

Autocorrelation FindAutocorrelation(const std::vector<Eigen::VectorXd>& rows,
                                    std::size_t most_lags) {
  std::vector<Eigen::VectorXd> known;  // what is missing as a zero, which adds nothing
  double squares = 0.0;
  Eigen::Index count = 0;
  for (const Eigen::VectorXd& row : rows) {
    known.push_back(row.unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; }));
    squares += known.back().squaredNorm();
    count += row.array().isFinite().count();
  }
  Autocorrelation found;
  if (!(squares > 0.0)) return found;
  found.band = 2.0 / std::sqrt(static_cast<double>(count));
  for (std::size_t lag = 1; lag <= most_lags && lag < rows.size(); ++lag) {
    double products = 0.0;
    for (std::size_t i = 0; i + lag < rows.size(); ++i) products += known[i].dot(known[i + lag]);
    found.of_lag.push_back(products / squares);
  }
  return found;
}

}  // namespace hexcal
