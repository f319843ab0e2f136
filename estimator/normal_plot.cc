// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_plot.h"

#include <algorithm>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kOutside = 0.05;

// Ranks from 1: every one of the first and last quarter of those that are shown, some between.
std::vector<std::size_t> RanksOf(std::size_t count, std::size_t most) {
  std::vector<std::size_t> ranks;
  const std::size_t ends = most / 4, middle = count - std::min(count, 2 * ends);
  const std::size_t stride = count <= most ? 1 : (middle + most / 2 - 1) / (most / 2);
  for (std::size_t i = 1; i <= count; ++i)
    if (i <= ends || i > count - ends || (i - ends - 1) % stride == 0) ranks.push_back(i);
  return ranks;
}

}  // namespace

std::vector<NormalPlotPoint> NormalPlot(std::vector<double> values, std::size_t most_points) {
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  std::vector<NormalPlotPoint> points;
  for (const std::size_t rank : RanksOf(count, std::max<std::size_t>(most_points, 4))) {
    // In the upper half by its mirror image: 1 - p would lose the digits of p.
    const bool is_upper = 2 * rank > count + 1;
    const double a = static_cast<double>(is_upper ? count + 1 - rank : rank);
    const double b = static_cast<double>(count + 1) - a;
    const auto limit = [&](double probability) {
      return NormalQuantile(BetaQuantile(probability, a, b));
    };
    const double low = limit(0.5 * kOutside), high = limit(1.0 - 0.5 * kOutside);
    const double expected = limit(0.5);
    points.push_back(is_upper ? NormalPlotPoint{rank, values[rank - 1], -expected, -high, -low}
                              : NormalPlotPoint{rank, values[rank - 1], expected, low, high});
  }
  return points;
}

}  // namespace hexcal
