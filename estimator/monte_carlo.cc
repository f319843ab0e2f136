// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/monte_carlo.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>

#include "estimator/pose_repetition.h"
#include "estimator/rounding_noise.h"

namespace hexcal {
namespace {

constexpr double kCoverage = 0.95;
constexpr double kNormalFactor = 1.959963984540054;  // of a 95 % interval
constexpr int kDigits = 2;
// The draws are cut into so many blocks, whose scatter tells how still the limits stand.
constexpr int kBlocks = 10;
// Noise below so many roundings of the data is none.

using Block = Repetition::Block;

// The ends of the probabilistically symmetric interval (JCGM 101, 7.7).
std::pair<double, double> Ends(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto m = static_cast<std::ptrdiff_t>(values.size());
  const std::ptrdiff_t inside = std::llround(kCoverage * static_cast<double>(m));
  const std::ptrdiff_t low = std::max<std::ptrdiff_t>((m - inside) / 2 - 1, 0);
  return {values[low], values[std::min(low + inside, m - 1)]};
}

// Of one parameter over some of the blocks, by control variates.
struct Limits {
  double low = 0.0, high = 0.0, bias = 0.0;
};

Limits LimitsOf(
    const std::vector<Block>& blocks, std::size_t first, std::size_t count, int row, double sigma) {
  std::vector<double> estimator, linear;
  double bias = 0.0;
  for (std::size_t b = first; b < first + count; ++b)
    for (Eigen::Index k = 0; k < blocks[b].linear.cols(); ++k) {
      estimator.push_back(blocks[b].estimator(row, k));
      linear.push_back(blocks[b].linear(row, k));
      bias += estimator.back() - linear.back();
    }
  const auto [low, high] = Ends(estimator);
  const auto [linear_low, linear_high] = Ends(linear);
  return {low - linear_low - kNormalFactor * sigma,
          high - linear_high + kNormalFactor * sigma,
          bias / static_cast<double>(linear.size())};
}

IntervalCheck CheckOne(const std::vector<Block>& blocks, int row, double sigma) {
  IntervalCheck check;
  check.sigma = sigma;
  check.tolerance = NumericalTolerance(sigma, kDigits);
  const Limits all = LimitsOf(blocks, 0, blocks.size(), row, sigma);
  check.low = all.low, check.high = all.high, check.bias = all.bias;
  check.low_difference = std::abs(all.low + kNormalFactor * sigma);
  check.high_difference = std::abs(all.high - kNormalFactor * sigma);
  check.agrees =
      check.low_difference <= check.tolerance && check.high_difference <= check.tolerance;
  // Two standard errors of the mean over the blocks.
  double low = 0.0, high = 0.0, low_squares = 0.0, high_squares = 0.0;
  const auto count = static_cast<double>(blocks.size());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Limits one = LimitsOf(blocks, b, 1, row, sigma);
    low += one.low / count, high += one.high / count;
    low_squares += one.low * one.low / count, high_squares += one.high * one.high / count;
  }
  const double variance = std::max(low_squares - low * low, high_squares - high * high);
  check.accuracy = 2.0 * std::sqrt(std::max(variance, 0.0) / (count - 1.0));
  return check;
}

// Runs blocks number first to first + kBlocks, a few at a time, in order.
void Append(const Repetition& repetition,
            const MonteCarloOptions& options,
            std::vector<Block>* blocks) {
  const std::size_t end = blocks->size() + kBlocks;
  std::deque<std::future<Block>> running;
  const int size = std::max(options.draws / kBlocks, 1);
  for (std::size_t next = blocks->size(); blocks->size() < end;) {
    for (; next < end && running.size() < static_cast<std::size_t>(std::max(options.threads, 1));
         ++next) {
      running.push_back(std::async(std::launch::async, [&repetition, &options, size, next] {
        return repetition.Run(size, options.seed, next);
      }));
    }
    blocks->push_back(running.front().get());
    running.pop_front();
    if (options.progress)
      options.progress(static_cast<long>(blocks->size()), static_cast<long>(end));
  }
}

void Keep(const std::vector<Block>& blocks, PropagationCheck* check) {
  check->estimates.resize(blocks.front().estimator.rows(), check->draws);
  Eigen::Index next = 0;
  for (const Block& block : blocks) {
    check->estimates.middleCols(next, block.estimator.cols()) = block.estimator;
    next += block.estimator.cols();
  }
}

}  // namespace

double NumericalTolerance(double sigma, int digits) {
  if (!(sigma > 0) || !std::isfinite(sigma)) return 0.0;
  return 0.5 * std::pow(10.0, std::floor(std::log10(sigma)) + 1 - digits);
}

PropagationCheck CheckPropagation(const Observations& observations,
                                  const NoiseLevels& levels,
                                  const Estimate& estimate,
                                  const MonteCarloOptions& options) {
  PropagationCheck check;
  check.why_not = WhyNotRepeated(observations, estimate);
  if (!check.why_not.empty()) return check;
  return CheckRepetition(PoseRepetition(observations, levels, estimate), options);
}

std::string WhyNotRepeated(const Observations& observations, const Estimate& estimate) {
  if (!estimate.converged) return "the solver did not converge";
  if (estimate.observability.null_directions > 0)
    return "the data do not determine " + estimate.observability.weak_directions[0];
  const NoiseLevels rounding = Rounding(observations.items);
  if (!(estimate.noise.position > kRoundingsOfNoise * rounding.position &&
        estimate.noise.orientation > kRoundingsOfNoise * rounding.orientation))
    return "there is no noise to repeat but rounding";
  return "";
}

PropagationCheck CheckRepetition(const Repetition& repetition, const MonteCarloOptions& options) {
  PropagationCheck check;
  std::vector<Block> blocks;
  for (int round = 0; round < options.most_rounds && !check.stable; ++round) {
    Append(repetition, options, &blocks);
    check.stable = check.validated = true;
    for (int i = 0; i < 12; ++i) {
      check.intervals[i] = CheckOne(blocks, i, repetition.sigma()[i]);
      check.stable = check.stable &&
                     check.intervals[i].accuracy <= kSettledShare * check.intervals[i].tolerance;
      check.validated = check.validated && check.intervals[i].agrees;
    }
  }
  check.done = true;
  for (const Block& block : blocks) {
    check.draws += static_cast<int>(block.linear.cols());
    check.not_converged += block.not_converged;
  }
  if (options.keep_draws) Keep(blocks, &check);
  return check;
}

}  // namespace hexcal
