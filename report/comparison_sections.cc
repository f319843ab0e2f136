// SPDX-License-Identifier: BSD-3-Clause
#include "report/comparison_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimator/propagation_verdict.h"
#include "report/estimate_charts.h"
#include "report/quantity.h"

namespace hexcal {

void AddMethods(const Comparison& comparison, HtmlPage* page) {
  HtmlTable table = {{{"method"},
                      {"largest difference, standard deviations", true},
                      {"held out, mm", true},
                      {"held out, mrad", true},
                      {"converged"}},
                     {}};
  for (const MethodResult& method : comparison.methods) {
    double largest = 0.0;
    for (const double s : method.sigmas)
      if (std::isfinite(s)) largest = std::max(largest, std::abs(s));
    table.rows.push_back({std::string(InfoOf(method.method).title),
                          fmt::format("{:.3g}", largest),
                          method.held_out ? MilliText(method.held_out->position) : "",
                          method.held_out ? MilliText(method.held_out->orientation) : "",
                          method.fit.converged ? "yes" : "no"});
  }
  page->Table(table);
  page->Note(fmt::format(
      "Differences are from the nonlinear solution by poses, the largest of the 12. Held out: RMS "
      "error of poses that the method has not seen{}, with the noise of their own measurement in "
      "it.",
      comparison.folds > 0 ? fmt::format(", one of {} parts of them at a time", comparison.folds)
                           : ""));
  std::vector<Chart> arrivals;
  for (const MethodResult& method : comparison.methods)
    if (method.method == Method::kPaper || method.method == Method::kNonlinear)
      arrivals.push_back(ConvergenceChart(
          method.fit.iterations,
          method.method == Method::kPaper ? "paper's iteration" : "nonlinear solver"));
  page->Figures(arrivals);
  page->Note(
      "The paper's iteration starts at the dataset's first guess, or at no motion; the nonlinear "
      "solver at the best closed form.");
}

namespace {

std::string OutcomeOf(const PropagationCheck& propagation) {
  switch (VerdictOf(propagation)) {
    case PropagationVerdict::kValidated:
      return "validated for all 12 parameters";
    case PropagationVerdict::kDiffers: {
      std::string wrong;
      for (int i = 0; i < 12; ++i)
        if (propagation.stable ? !propagation.intervals[i].agrees
                               : IsFoundToDiffer(propagation.intervals[i]))
          wrong += (wrong.empty() ? "" : ", ") + std::string(kParameters[i].name);
      return "found to differ from those of repetition: " + wrong;
    }
    case PropagationVerdict::kUndecided:
      break;
  }
  return fmt::format("undecided: {} repetitions were made, about {:.0f} are needed",
                     propagation.draws,
                     DrawsNeeded(propagation));
}

}  // namespace

void AddPropagation(const PropagationCheck& propagation, HtmlPage* page) {
  page->Heading("May the covariance of first order be used?");
  if (!propagation.done) return page->Paragraph("Not checked: " + propagation.why_not + ".");
  page->Paragraph(
      fmt::format("The measurement was repeated {} times with the noise of every pose and "
                  "calibrated each time. "
                  "By the criterion of JCGM 101:2008, clause 8, with two digits of the standard "
                  "uncertainty, the "
                  "95 % intervals of first-order propagation are {}.",
                  propagation.draws,
                  OutcomeOf(propagation)));
  if (propagation.not_converged > 0)
    page->Paragraph(
        fmt::format("{} of the repetitions did not converge; where they ended counts all the same.",
                    propagation.not_converged));
}

}  // namespace hexcal
