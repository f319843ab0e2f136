// SPDX-License-Identifier: BSD-3-Clause
#include "report/compare_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "estimator/propagation_verdict.h"

namespace hexcal {
namespace {

// The largest of three differences, as long as it is one: "0.31", "12", "4e+03".
std::string SigmasText(const Eigen::Vector3d& sigmas) {
  if (!sigmas.allFinite()) return "-";
  const double largest = sigmas.cwiseAbs().maxCoeff();
  if (largest < 0.005) return "0";
  return largest < 9.95   ? fmt::format("{:.2f}", largest)
         : largest < 9999 ? fmt::format("{:.0f}", largest)
                          : fmt::format("{:.0e}", largest);
}

std::string IterationsText(const MethodFit& fit) {
  if (fit.iterations.empty()) return "-";
  return fmt::format("{}{}", fit.iterations.size() - 1, fit.converged ? "" : " (no convergence)");
}

std::string MethodLine(const MethodResult& result) {
  const std::string held_out = result.held_out ? fmt::format("{:>9.4g} {:>9.4g}",
                                                             1e3 * result.held_out->position,
                                                             1e3 * result.held_out->orientation)
                                               : fmt::format("{:>9} {:>9}", "-", "-");
  return fmt::format("  {:<18}{:>6} {:>6} {:>7} {:>6}   {:>9.4g} {:>9.4g} {}{:>10.3g}   {}\n",
                     InfoOf(result.method).title,
                     SigmasText(result.sigmas.segment<3>(0)),
                     SigmasText(result.sigmas.segment<3>(3)),
                     SigmasText(result.sigmas.segment<3>(6)),
                     SigmasText(result.sigmas.segment<3>(9)),
                     1e3 * result.rmspe,
                     1e3 * result.rmsoe,
                     held_out,
                     1e3 * result.seconds,
                     IterationsText(result.fit));
}

std::string Methods(const Comparison& comparison) {
  std::string text = fmt::format(
      "  {:<18}{:<14}{:<17}{:<20}{:<19}{:>10}\n",
      "",
      "  base, σ",
      "   tool, σ",
      "left over",
      comparison.folds > 0 ? fmt::format("held out, {} folds", comparison.folds) : "held out",
      "time");
  text += fmt::format("  {:<18}{:>6} {:>6} {:>7} {:>6}   {:>9} {:>9} {:>9} {:>9}{:>10}   {}\n",
                      "method",
                      "shift",
                      "turn",
                      "shift",
                      "turn",
                      "mm",
                      "mrad",
                      "mm",
                      "mrad",
                      "ms",
                      "iterations");
  for (const MethodResult& result : comparison.methods) text += MethodLine(result);
  return text;
}

std::string Verdict(const PropagationCheck& check) {
  if (!check.done) return "not checked: " + check.why_not;
  const PropagationVerdict verdict = VerdictOf(check);
  if (verdict == PropagationVerdict::kUndecided)
    return fmt::format("undecided: {} draws made, about {:.0f} needed (JCGM 101 clause 8)",
                       check.draws,
                       DrawsNeeded(check));
  std::string wrong;
  for (int i = 0; i < 12; ++i)
    if (check.stable ? !check.intervals[i].agrees : IsFoundToDiffer(check.intervals[i]))
      wrong += (wrong.empty() ? "" : ", ") + std::string(kParameters[i].name);
  return fmt::format("{} (JCGM 101 clause 8, {} draws)",
                     verdict == PropagationVerdict::kValidated
                         ? "may be used: its 95 % intervals are those of repetition to two digits"
                         : "differs from repetition in its second digit: " + wrong,
                     check.draws);
}

// One row of a map: its cells in columns of eight.
template <typename ToText>
std::string Cells(const std::vector<double>& values, const ToText& text) {
  std::string row;
  for (const double value : values) row += fmt::format("{:>8}", text(value));
  return row;
}

// Both maps side by side: rotation errors down, translation errors across.
std::string Maps(const CompareOptions& options, const Comparison& comparison) {
  const ConvergenceMap &paper = comparison.paper_map, &twist = comparison.twist_map;
  const auto millimetres = [](double m) {
    return m < 0.1 ? fmt::format("{:.3g}", 1e3 * m) : fmt::format("{:.0f}", 1e3 * m);
  };
  const auto percent = [](double share) { return fmt::format("{:.0f}", 100.0 * share); };
  std::string text = fmt::format(
      "\n  of {} starts, % that arrive within {} iterations; both mounts turned (down) and moved "
      "(across)\n  {:>5}{:>32}   {:>32}\n  {:>5}{}   {} mm\n",
      options.starts,
      options.calibrate.linearized.max_iterations,
      "",
      paper.has_limit ? "paper's iteration" : "paper's iteration (no limit)",
      twist.has_limit ? "twist iteration" : "twist iteration (no limit)",
      "deg",
      Cells(paper.translation_errors, millimetres),
      Cells(twist.translation_errors, millimetres));
  for (std::size_t i = 0; i < paper.rotation_errors.size(); ++i)
    text += fmt::format("  {:>5.0f}{}   {}\n",
                        paper.rotation_errors[i] * 180.0 / kPi,
                        Cells(paper.share[i], percent),
                        Cells(twist.share[i], percent));
  return text;
}

}  // namespace

std::string CompareTable(const std::string& dataset,
                         const CompareOptions& options,
                         const Comparison& comparison) {
  const Estimate& reference = comparison.reference;
  std::string text = fmt::format(
      "{}: {} poses; differences from the nonlinear solution in its standard "
      "deviations (σ), the largest of three\n\n",
      dataset,
      reference.poses.size());
  text += Methods(comparison);
  text += fmt::format("\n  best anywhere  {}: {}\n",
                      comparison.certificate.certified ? "proven" : "not proven",
                      comparison.certificate.why);
  text += fmt::format("  covariance     {}\n", Verdict(comparison.propagation));
  if (options.starts > 0) text += Maps(options, comparison);
  return text;
}

}  // namespace hexcal
