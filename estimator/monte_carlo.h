// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "estimator/estimate.h"
#include "estimator/observations.h"

namespace hexcal {

struct MonteCarloOptions {
  int draws = 10000;  // to begin with; as many again until the limits stand still
  int most_rounds = 10;
  std::uint64_t seed = 1;
  int threads = 1;                           // the result does not depend on it
  std::function<void(long, long)> progress;  // done, of; from the calling thread
  bool keep_draws = false;
};

// Limits stand still whose accuracy is within this share of the tolerance (8.2).
constexpr double kSettledShare = 0.2;

// The 95 % interval of one parameter by the covariance against that by repetition, about the
// estimate; m or rad.
struct IntervalCheck {
  double sigma = 0.0;            // by the covariance
  double tolerance = 0.0;        // half a unit of sigma's second digit (JCGM 101, 7.9.2)
  double low = 0.0, high = 0.0;  // of the draws, minus the estimate
  double low_difference = 0.0, high_difference = 0.0;  // from -+1.96 sigma
  double accuracy = 0.0;                               // two standard errors of low and high
  double bias = 0.0;                                   // mean of the draws minus the estimate
  bool agrees = false;                                 // both differences within the tolerance
};

// JCGM 101:2008, clause 8: may the covariance that first-order propagation gives be used? The
// estimated machine is measured again and again with the noise of every pose, and calibrated.
struct PropagationCheck {
  bool done = false;
  std::string why_not;
  int draws = 0;
  int not_converged = 0;
  std::array<IntervalCheck, 12> intervals;
  bool stable = false;     // every accuracy within a fifth of its tolerance (8.2)
  bool validated = false;  // every interval agrees
  // Where they were to be kept: what each repetition estimated, minus the estimate. 12 x draws;
  // more rows where more than base and tool is estimated.
  Eigen::MatrixXd estimates;
};

// A measurement that can be made again with other noise, and estimated from.
class Repetition {
 public:
  // Draws of the estimator and, from the same noise, of its linear part; minus the estimate. A
  // draw a column, the 12 parameters first.
  struct Block {
    Eigen::MatrixXd estimator, linear;
    int not_converged = 0;
  };
  virtual ~Repetition() = default;
  // Standard deviations of the linear part.
  virtual const Eigen::VectorXd& sigma() const = 0;
  // The block of that number, the same whenever and wherever it is drawn.
  virtual Block Run(int draws, std::uint64_t seed, std::size_t number) const = 0;
};

// Of the weighted least-squares fit by poses (estimator/pose_repetition.h has the others).
// The limits are those of the draws, less what the linear estimator, whose limits are known, makes
// of the same draws (control variates): what is left is the work of nonlinearity alone, and stands
// still after far fewer draws than plain ones need.
PropagationCheck CheckPropagation(const Observations& observations,
                                  const NoiseLevels& levels,
                                  const Estimate& estimate,
                                  const MonteCarloOptions& options);

// The same of any repetition, for its first 12 parameters.
PropagationCheck CheckRepetition(const Repetition& repetition, const MonteCarloOptions& options);

// Why an estimate is not to be repeated; empty: it may be.
std::string WhyNotRepeated(const Observations& observations, const Estimate& estimate);

// JCGM 101, 7.9.2: half of one unit in the last of so many digits of a standard uncertainty.
double NumericalTolerance(double sigma, int digits);

}  // namespace hexcal
