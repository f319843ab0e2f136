// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "report/discovery_given.h"
#include "report/discovery_words.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kWidth = 96;
constexpr std::size_t kIndent = 17;

// "  label          text", further lines below the text.
std::string Paragraph(const std::string& label, const std::string& text) {
  std::string lines = fmt::format("  {:<15}", label);
  std::size_t column = kIndent;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (column > kIndent && column + 1 + word.size() > kWidth) {
      lines += fmt::format("\n{:{}}", "", kIndent);
      column = kIndent;
    } else if (column > kIndent) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    at = end + 1;
  }
  return lines + "\n";
}

std::string Found(const DiscoveredEffect& found, std::size_t number) {
  std::string text = Paragraph(fmt::format("found {}", number),
                               fmt::format("{}, {}: p = {}, {} of the held-out gap closed",
                                           found.effect.name,
                                           CarriersOf(found),
                                           ProbabilityText(found.p_value),
                                           ShareText(found.gap_closed)));
  if (!found.description.empty()) text += Paragraph("", found.description);
  for (const std::string& line : SizesOf(found)) text += Paragraph("", line);
  for (const Rival& rival : found.could_also_be)
    text += Paragraph("", fmt::format("could also be {}: {}", rival.name, rival.why));
  return text;
}

std::string GapLine(const char* what, const GapSize& size) {
  if (!IsKnown(size)) return "";
  std::string text = fmt::format(
      "  {:<22}{:>12.4f}{:>12.4f}", what, 1e3 * size.rms_position, 1e3 * size.rms_orientation);
  if (size.degrees_of_freedom > 0)
    text += fmt::format("{:>14.1f}{:>8}", size.chi_square, size.degrees_of_freedom);
  return text + "\n";
}

std::string GapTable(const Gap& gap) {
  return fmt::format(
             "  {:<22}{:>12}{:>12}{:>14}{:>8}\n", "gap (RMS)", "mm", "mrad", "chi-square", "dof") +
         GapLine("  before", gap.before) + GapLine("  after", gap.after) +
         GapLine("  held out, before", gap.heldout_before) +
         GapLine("  held out, after", gap.heldout_after) +
         GapLine("  noise floor", gap.noise_floor);
}

using NamesByNeeds = std::vector<std::pair<std::string, std::vector<std::string>>>;

NamesByNeeds ByNeeds(const std::vector<NotTestable>& effects) {
  NamesByNeeds groups;
  for (const NotTestable& effect : effects) {
    auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& known) {
      return known.first == effect.needs;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {effect.needs, {}});
    group->second.push_back(effect.name);
  }
  return groups;
}

}  // namespace

std::string DiscoveryTable(const std::string& dataset, const Discovery& discovery) {
  std::string text = fmt::format(
      "{}: {} poses, {}\n\n", dataset, discovery.poses.size(), NameOf(discovery.verdict));
  text += Paragraph("verdict", VerdictSentence(discovery));
  for (const GivenEffect& given : discovery.given)
    text += Paragraph(
        "given",
        fmt::format("{}, {}: {}", given.now.effect.name, CarriersOf(given.now), SentenceOf(given)));
  for (std::size_t i = 0; i < discovery.effects.size(); ++i)
    text += "\n" + Found(discovery.effects[i], i + 1);
  text += "\n" + GapTable(discovery.gap) + "\n";
  std::vector<std::string> lines = NoiseSentences(discovery.noise);
  if (!lines.empty()) text += Paragraph("noise", fmt::format("{}", fmt::join(lines, " ")));
  lines.clear();
  for (const auto& [needs, names] : ByNeeds(discovery.not_testable))
    lines.push_back(fmt::format("{} (needs {})", fmt::join(names, ", "), needs));
  if (!lines.empty()) text += Paragraph("not testable", fmt::format("{}", fmt::join(lines, "; ")));
  lines.clear();
  for (const Detectable& effect : discovery.detectable)
    lines.push_back(fmt::format(
        "{} {}", NameWithIndex(effect.name, effect.index), SizeText(effect.smallest, effect.unit)));
  if (!lines.empty())
    text += Paragraph(
        "would be seen",
        fmt::format("in four data sets of five, from this size on: {}", fmt::join(lines, ", ")));
  return text;
}

}  // namespace hexcal
