// SPDX-License-Identifier: BSD-3-Clause
#include "report/plan_table.h"

#include <fmt/format.h>

#include <cmath>

#include "estimator/covariance.h"
#include "report/discovery_words.h"
#include "report/plan_words.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kWidth = 96, kIndent = 6;

// Lines of at most kWidth, all indented.
std::string Wrapped(const std::string& text) {
  std::string lines, line;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!line.empty() && kIndent + line.size() + 1 + word.size() > kWidth) {
      lines += fmt::format("{:{}}{}\n", "", kIndent, line);
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines + fmt::format("{:{}}{}\n", "", kIndent, line);
}

std::string Deviation(double deviation, bool is_angle) {
  return std::isnan(deviation) ? "undetermined" : SizeText(deviation, is_angle ? "rad" : "m");
}

std::string Parameters(const Plan& plan) {
  std::string text = fmt::format("  {:<22}{:>14}{:>14}\n", "1-sigma", "now", "then");
  for (std::size_t k = 0; k < kParameters.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    text += fmt::format("  {:<22}{:>14}{:>14}\n",
                        kParameters[k].name,
                        Deviation(plan.deviation_before[row], kParameters[k].is_angle),
                        Deviation(plan.deviation_after[row], kParameters[k].is_angle));
  }
  return text;
}

// Below a tenth of a per cent nobody counts.
std::string MistakeText(double distance) {
  const double chance = ChanceOfMistake(distance);
  return chance < 1e-3 ? "< 0.1 %" : fmt::format("{:.1f} %", 100.0 * chance);
}

std::string Line(const std::string& what, double before, double after, const std::string& chance) {
  return fmt::format("  {:<52}{:>8.1f}{:>8.1f}{:>16}\n", what, before, after, chance);
}

std::string Pairs(const Plan& plan) {
  std::string text =
      fmt::format("  {:<52}{:>8}{:>8}{:>16}\n", "sigmas apart", "now", "then", "then mistaken");
  std::string before;
  for (const RivalPair& pair : plan.pairs) {
    const std::string effect = NameWithIndex(pair.effect, pair.index);
    if (effect != before)
      text += Line(effect + " from no effect", pair.size_before, pair.size_after, "");
    before = effect;
    text += Line("  from " + pair.rival, pair.before, pair.after, MistakeText(pair.after));
    text += Wrapped(SeparationSentence(plan, pair));
  }
  return text;
}

}  // namespace

std::string PlanTable(const std::string& dataset, const Plan& plan) {
  const bool for_rivals = plan.goal == PlanGoal::kRivals;
  std::string text =
      fmt::format("{}: {} poses to measure next, {}; {} measured, {} to choose from\n\n",
                  dataset,
                  plan.poses.rows.size(),
                  for_rivals ? "to tell rivals apart" : "for base and tool",
                  plan.measured,
                  plan.pool);
  if (!plan.pairs.empty()) text += Pairs(plan) + "\n";
  if (for_rivals && plan.pairs.empty()) text += "  no rivals are left\n\n";
  return text + Parameters(plan);
}

std::string PlanComments(const std::string& dataset, const Plan& plan) {
  std::string text = fmt::format(
      "{} for {}: robot_poses of a new dataset, in the order in which to measure them\n",
      kPlanMark,
      dataset);
  for (std::size_t k = 0; k < plan.poses.rows.size(); ++k)
    text += fmt::format("# {}: {}\n", plan.poses.rows[k].label, ReasonText(plan, plan.reasons[k]));
  return text;
}

}  // namespace hexcal
