// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// Normal, Student's t, chi-square, beta and Fisher's F, from Boost.Math. Degrees of freedom may be
// fractions, above 0. Quantile: below it lies that probability, in (0, 1). Tail: the probability
// above x; it keeps its digits where it is small, and is 0 below 1e-308.
double NormalQuantile(double probability);
double BetaQuantile(double probability, double a, double b);

double StudentTQuantile(double probability, double degrees_of_freedom);
double StudentTTail(double x, double degrees_of_freedom);

double ChiSquareQuantile(double probability, double degrees_of_freedom);
double ChiSquareTail(double x, double degrees_of_freedom);  // x from 0; NaN below
// The noncentrality with which chi-square exceeds the limit that it else exceeds with probability
// alpha, with this power; above alpha, below 1.
double ChiSquareNoncentrality(double alpha, double power, double degrees_of_freedom);

double FisherFQuantile(double probability, double numerator_dof, double denominator_dof);
double FisherFTail(double x, double numerator_dof, double denominator_dof);  // x from 0; NaN below
double FisherFDensity(double x, double numerator_dof, double denominator_dof);

// The 95 % (or another confidence) limits of a probability that this many successes in so many
// trials confirm, trials above 0: exact, never less sure than stated. Reference: C. J. Clopper, E.
// S. Pearson, Biometrika 26 (1934).
struct BinomialInterval {
  double low = 0.0, high = 1.0;
};
BinomialInterval ClopperPearson(long successes, long trials, double confidence);

// The probability that n F(n, a) + n F(n, b) exceeds x, for independent F: two sums of n squares,
// each in units of its own estimated variance.
double FisherSumTail(double x, double n, double a, double b);

}  // namespace hexcal
