// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/quantity.h"

namespace hexcal {
namespace {

// The repeated length against that at worst, which stands above it.
std::string AgainstStated(const PointReport& report) {
  const TargetCheck& check = *report.check;
  if (check.exceeds_stated)
    return fmt::format("LONGER than stated, {} are within that",
                       ShareText(static_cast<double>(check.inside_stated) / check.draws));
  return check.agrees ? "as stated" : "they do NOT agree";
}

std::string PointLines(const PointReport& report, const RepeatedAs& repeated) {
  std::string text =
      fmt::format("  {}: the error is not longer than, with 95 %\n", report.point.name);
  text += fmt::format("    {:<15}{} (RMS {})\n",
                      "at the centre",
                      SizeText(report.centre.length_95, "m"),
                      SizeText(report.centre.rms, "m"));
  text += fmt::format("    {:<15}{} (RMS {}), at {}\n",
                      "at worst",
                      SizeText(report.worst.length_95, "m"),
                      SizeText(report.worst.rms, "m"),
                      WordsOf(report.worst.place));
  for (const BudgetRow& row : report.budget.rows)
    text += fmt::format("    {:<32}{:>10} RMS {:>9}\n",
                        LabelOf(row),
                        SizeText(row.contribution, "m"),
                        ShareText(row.share));
  if (report.check)
    text += fmt::format("    by {} repetitions{} {} ({} by first order, noise as known): {}\n",
                        report.check->draws,
                        repeated.is_audits ? "" : " of " + repeated.words,
                        SizeText(report.check->repeated_quantile, "m"),
                        SizeText(report.check->quantile, "m"),
                        AgainstStated(report));
  return text;
}

// NaN: not determined.
double LargestOf(const Vector12d& values) {
  double largest = 0.0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

std::string ChangeLine(const Change& change) {
  const std::string& path = change.earlier.path;
  if (change.shared.poses > 0)
    return fmt::format(
        "  changed        by at most {:.2g} standard uncertainties since {}; not tested, "
        "as {} poses have the same readings in both\n",
        LargestOf(change.over_own),
        path,
        change.shared.poses);
  if (change.is_of_exact)
    return fmt::format("  changed        not tested since {}: {}\n", path, kOfExactData);
  return fmt::format("  changed        chi-square {:.4g} of 12 since {} (p {}{})\n",
                     change.chi_square,
                     path,
                     ProbabilityText(change.p_value),
                     change.shared.is_known ? "" : ", if no reading is in both");
}

}  // namespace

std::string AuditTable(const Audit& audit) {
  const Estimate& estimate = audit.estimate;
  std::string text = fmt::format("{}: {} poses, verdict {}\n\n",
                                 audit.header.dataset,
                                 estimate.poses.size(),
                                 NameOf(audit.compliance));
  if (audit.decisions.empty()) text += "  no requirement was given (--requirement)\n\n";
  for (const Decision& decision : audit.decisions)
    text += fmt::format("  {:<13}{}: {}\n\n",
                        NameOf(decision.compliance),
                        decision.requirement.name,
                        decision.reason);
  for (const PointReport& report : audit.points) text += PointLines(report, audit.repeated) + "\n";
  text += GlobalTestLines(audit.global, estimate);
  if (audit.readings) text += ReadingLines(*audit.readings);
  if (audit.held_out.poses > 0 && !audit.global.is_rounding)
    text +=
        fmt::format("  held out       {} of {} poses in their 95 % region; {} RMS, {} expected\n",
                    audit.held_out.inside,
                    audit.held_out.poses,
                    SizeText(audit.held_out.rms_position, "m"),
                    SizeText(audit.held_out.expected_position, "m"));
  if (audit.change) text += ChangeLine(*audit.change);
  for (const std::string& doubt : audit.doubts) text += fmt::format("  doubt          {}\n", doubt);
  return text;
}

}  // namespace hexcal
