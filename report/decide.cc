// SPDX-License-Identifier: BSD-3-Clause
#include "report/decide.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/error_length.h"
#include "geometry/linear_algebra.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr double kCoverageFactor = 2.0;

// The degrees of freedom with which the calibration's covariance is known: where the noise was
// stated, those with which the residuals confirm it.
double FreedomOf(const Audit& audit) {
  return std::min(LeastDegreesOfFreedom(audit.estimate),
                  static_cast<double>(audit.estimate.degrees_of_freedom));
}

// Of a root of a sum of variances, relative: by the shares that are known by so many degrees of
// freedom.
double RelativeUncertainty(const TargetCovariance& at,
                           const Audit& audit,
                           const TargetError& error) {
  double squares = std::pow(at.calibration.trace(), 2) / FreedomOf(audit);
  for (std::size_t i = 0; i < at.shares.size(); ++i)
    squares += std::pow(at.shares[i].trace(), 2) / error.sources()[i].degrees_of_freedom;
  return std::sqrt(0.5 * squares) / at.total.trace();
}

// What repetition has the length differ by, relative; nothing where it agrees.
double OfNonlinearity(const Audit& audit, std::size_t point) {
  if (point >= audit.points.size() || !audit.points[point].check) return 0.0;
  const TargetCheck& check = *audit.points[point].check;
  if (check.agrees) return 0.0;
  return std::abs(check.repeated_quantile - check.quantile) / check.quantile;
}

std::string Sentence(const Decision& decision, const NamedPoint& point, const Audit& audit) {
  const Requirement& asked = decision.requirement;
  const std::string size = fmt::format(
      "With a probability of {} the error of {} is not longer than {} where it is worst; with its "
      "guard band of {} "
      "that is",
      ShareText(asked.probability),
      point.name,
      SizeText(decision.value, "m"),
      SizeText(decision.guard, "m"));
  const std::string limit = SizeText(asked.limit, "m");
  if (decision.compliance == Compliance::kPass)
    return fmt::format("{} within the limit of {}.", size, limit);
  const std::string beyond = fmt::format(
      "The error of {} may be {} long where it is worst (it is not longer with a "
      "probability of {}); even {} less, its guard band, is beyond the limit of {}",
      point.name,
      SizeText(decision.value, "m"),
      ShareText(asked.probability),
      SizeText(decision.guard, "m"),
      limit);
  if (decision.compliance == Compliance::kFail) return beyond + ".";
  if (decision.value - decision.guard > asked.limit)
    return beyond +
           ", but what is left over is less than the stated noise explains, so that the error may "
           "be shorter.";
  if (decision.value + decision.guard > asked.limit)
    return fmt::format("{} neither surely within nor surely beyond the limit of {}.", size, limit);
  std::string why;
  for (const std::string& doubt : audit.doubts) why += (why.empty() ? "" : "; ") + doubt;
  return fmt::format("{} within the limit of {}, but {}.", size, limit, why);
}

// What a sentence about the workspace rests on where no pose was.
std::string Reservation(const Audit& audit, const Requirement& requirement) {
  const std::string beyond = BeyondPoses(audit.workspace);
  if (requirement.over != Requirement::Places::kWorkspace || beyond.empty()) return "";
  return fmt::format(
      " This is in part extrapolated by the model: no pose was measured at the ends of the "
      "workspace in {}.",
      beyond);
}

}  // namespace

Worst WorstPlace(const TargetError& error,
                 const Eigen::Vector3d& p_in_tool,
                 const std::vector<Place>& places,
                 double probability) {
  CHECK(!places.empty());
  struct Bounded {
    const Place* place;
    TargetCovariance at;
    double bound;  // the length of an error that is everywhere as along its longest axis
  };
  std::vector<Bounded> all;
  for (const Place& place : places) {
    Bounded one = {&place, error.At(place.base_from_platform, p_in_tool, place.row), 0.0};
    const double largest = DecomposeSymmetric(one.at.total).values[2];
    // Length of the unit ball's error once, scaled.
    one.bound = std::sqrt(std::max(largest, 0.0));
    all.push_back(std::move(one));
  }
  std::stable_sort(
      all.begin(), all.end(), [](const Bounded& a, const Bounded& b) { return a.bound > b.bound; });
  double least_freedom = all[0].at.degrees_of_freedom;
  for (const Bounded& one : all) least_freedom = std::min(least_freedom, one.at.degrees_of_freedom);
  const double ball = LengthQuantile(Eigen::Matrix3d::Identity(), probability, least_freedom);
  Worst worst = {*all[0].place, -1.0, 0.0};
  for (const Bounded& one : all) {
    if (ball * one.bound <= worst.length) break;
    const double length = one.at.Quantile(probability);
    if (length > worst.length) worst = {*one.place, length, one.at.degrees_of_freedom};
  }
  return worst;
}

Decision Decide(const Audit& audit,
                const Requirement& requirement,
                const std::vector<Place>& places) {
  Decision decision;
  decision.requirement = requirement;
  if (!audit.estimate.IsTrustworthy()) {
    decision.reason =
        "The 12 parameters cannot be trusted: " +
        (audit.estimate.converged
             ? "the data do not determine " + audit.estimate.observability.weak_directions[0]
             : "no convergence") +
        ".";
    return decision;
  }
  if (places.empty()) {
    decision.reason = "The legs do not reach the middle of the workspace.";
    return decision;
  }
  const NamedPoint& point = audit.requirements.points[requirement.point];
  const TargetError error = ErrorOf(audit, point);
  const Worst worst = WorstPlace(error, point.p_in_tool, places, requirement.probability);
  decision.worst = worst.place;
  decision.value = worst.length;
  const TargetCovariance at =
      error.At(worst.place.base_from_platform, point.p_in_tool, worst.place.row);
  decision.guard =
      kCoverageFactor * decision.value *
      std::hypot(RelativeUncertainty(at, audit, error), OfNonlinearity(audit, requirement.point));
  if (!(decision.value >= 0.0) || !std::isfinite(decision.guard)) {
    decision.reason =
        fmt::format("How far the error of {} may go could not be computed.", point.name);
    return decision;
  }
  if (decision.value + decision.guard <= requirement.limit && audit.doubts.empty())
    decision.compliance = Compliance::kPass;
  if (decision.value - decision.guard > requirement.limit && !audit.global.is_too_small)
    decision.compliance = Compliance::kFail;
  decision.reason = Sentence(decision, point, audit) + Reservation(audit, requirement);
  return decision;
}

Compliance Together(const std::vector<Decision>& decisions) {
  const auto has = [&](Compliance compliance) {
    return std::any_of(decisions.begin(), decisions.end(), [=](const Decision& decision) {
      return decision.compliance == compliance;
    });
  };
  if (decisions.empty()) return Compliance::kNotAsked;
  if (has(Compliance::kFail)) return Compliance::kFail;
  return has(Compliance::kInconclusive) ? Compliance::kInconclusive : Compliance::kPass;
}

}  // namespace hexcal
