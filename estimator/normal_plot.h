// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace hexcal {

// A number of a sample and what a standard normal sample of that size has at its place: the median
// of that order statistic, and the limits that it keeps with 95 %.
struct NormalPlotPoint {
  std::size_t rank = 0;  // from 1, the smallest
  double value = 0.0, expected = 0.0, low = 0.0, high = 0.0;
};

// Sorted. Of more than most_points the extremes are kept (an outlier is one) and of the others
// every so many. Number i of n sorted uniform ones is beta (i, n + 1 - i): H. A. David, H. N.
// Nagaraja, Order Statistics (2003), 2.1.
std::vector<NormalPlotPoint> NormalPlot(std::vector<double> values, std::size_t most_points);

}  // namespace hexcal
