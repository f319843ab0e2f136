// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/quantiles.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace hexcal {
namespace {

// Doubles throughout (long ones take three times as long), and no exception where a tail is too
// small for a number.
using Policy = boost::math::policies::policy<
    boost::math::policies::promote_double<false>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::underflow_error<boost::math::policies::ignore_error>>;
using StudentT = boost::math::students_t_distribution<double, Policy>;
using ChiSquare = boost::math::chi_squared_distribution<double, Policy>;
using FisherF = boost::math::fisher_f_distribution<double, Policy>;

template <typename Distribution>
double Tail(const Distribution& distribution, double x) {
  return boost::math::cdf(boost::math::complement(distribution, x));
}

}  // namespace

double StudentTQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(StudentT(degrees_of_freedom), probability);
}

double StudentTTail(double x, double degrees_of_freedom) {
  return Tail(StudentT(degrees_of_freedom), x);
}

double ChiSquareQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(ChiSquare(degrees_of_freedom), probability);
}

double ChiSquareTail(double x, double degrees_of_freedom) {
  return Tail(ChiSquare(degrees_of_freedom), x);
}

double FisherFQuantile(double probability, double numerator_dof, double denominator_dof) {
  return boost::math::quantile(FisherF(numerator_dof, denominator_dof), probability);
}

double FisherFTail(double x, double numerator_dof, double denominator_dof) {
  return Tail(FisherF(numerator_dof, denominator_dof), x);
}

double FisherFDensity(double x, double numerator_dof, double denominator_dof) {
  return boost::math::pdf(FisherF(numerator_dof, denominator_dof), x);
}

}  // namespace hexcal
