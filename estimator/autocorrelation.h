// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hexcal {

// How alike numbers are that lie so many steps apart, from -1 to 1.
struct Autocorrelation {
  std::vector<double> of_lag;  // of one step, two steps...
  double band = 0.0;  // 2 / sqrt(numbers): what has no order stays within it in 19 of 20 lags
};

// rows: one a step, of numbers with mean zero and about one variance, together (a row's numbers
// each with the same one of the other row). What is not finite has no part; nothing where that
// leaves all zero. G. E. P. Box, G. M. Jenkins, Time Series Analysis (1976), 2.1.6.
Autocorrelation FindAutocorrelation(const std::vector<Eigen::VectorXd>& rows,
                                    std::size_t most_lags);

}  // namespace hexcal
