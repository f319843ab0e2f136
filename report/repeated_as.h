// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "estimator/estimate.h"

namespace hexcal {

// What an audit repeats by Monte Carlo: the fit that it reports, or one that stands for it.
struct RepeatedAs {
  Estimate estimate;      // covariance_unscaled: by first order, the noise being as it is drawn
  bool is_audits = true;  // else another than the audit reports
  std::string words;      // which: "the nonlinear fit by poses"
};

// The least and the largest ratio of the 12 standard uncertainties reported to those of first order
// that the repetition checks.
std::array<double, 2> UncertaintyRatios(const RepeatedAs& repeated, const Estimate& reported);

// "Repeated is the fit of this report: ..." or which other stands for it, and how much its standard
// uncertainties differ from those of the one reported.
std::string RepeatedText(const RepeatedAs& repeated, const Estimate& reported);

}  // namespace hexcal
