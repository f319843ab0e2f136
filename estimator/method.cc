// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/method.h"

#include <glog/logging.h>

#include <algorithm>

#include "estimator/calibrate_markers.h"
#include "estimator/closed_form.h"

namespace hexcal {
namespace {

MethodFit FitOf(Estimate estimate) {
  return {estimate.mounts,
          estimate.converged,
          std::move(estimate.message),
          std::move(estimate.iterations)};
}

MethodFit Closed(ClosedForm form, const Observations& observations) {
  return {SolveClosedForm(form, observations.items), true, "", {}};
}

}  // namespace

const MethodInfo& InfoOf(Method method) {
  const auto found = std::find_if(kMethods.begin(), kMethods.end(), [method](const MethodInfo& m) {
    return m.method == method;
  });
  CHECK(found != kMethods.end());
  return *found;
}

MethodFit Fit(Method method,
              const Observations& observations,
              const std::optional<BaseAndTool>& initial,
              const CalibrateOptions& options,
              const MarkersOf& markers) {
  CalibrateOptions own = options;
  own.outliers = OutlierHandling::kNotSought;
  switch (method) {
    case Method::kPaper:
      own.solver = Solver::kLinearized;
      own.linearized.error = LinearizedOptions::Error::kPaper;
      return FitOf(Calibrate(observations, initial, own));
    case Method::kTwist:
      own.solver = Solver::kLinearized;
      own.linearized.error = LinearizedOptions::Error::kTwist;
      return FitOf(Calibrate(observations, initial, own));
    case Method::kZhuang:
      return Closed(ClosedForm::kZhuang, observations);
    case Method::kShah:
      return Closed(ClosedForm::kShah, observations);
    case Method::kLi:
      return Closed(ClosedForm::kLi, observations);
    case Method::kParkMartin:
      return Closed(ClosedForm::kParkMartin, observations);
    case Method::kNonlinear:
      own.solver = Solver::kNonlinear;
      own.start.reset();
      return FitOf(Calibrate(observations, initial, own));
    case Method::kMarker:
      CHECK(markers) << "no readings";
      own.solver = Solver::kNonlinear;
      own.start.reset();
      return FitOf(CalibrateMarkers(observations, markers(observations), initial, own));
    case Method::kRobust:
      own.solver = Solver::kNonlinear;
      own.start.reset();
      own.outliers = OutlierHandling::kReject;
      return FitOf(Calibrate(observations, initial, own));
  }
  return {};
}

}  // namespace hexcal
