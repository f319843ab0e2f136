// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_words.h"

#include <fmt/format.h>

#include <cmath>

#include "report/discovery_given.h"
#include "report/effect_numbers.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostNumbers = 18;

std::string NamesOf(const Discovery& discovery) {
  std::vector<std::string> names;
  for (const DiscoveredEffect& found : discovery.effects) {
    const bool has_name = found.effect.name != kUnknownEffect;
    std::string name = fmt::format(
        "{} ({})", has_name ? found.effect.name : "something without a name", CarriersOf(found));
    if (!found.could_also_be.empty()) name += " or what cannot be told from it";
    names.push_back(name);
  }
  return JoinWords(names);
}

}  // namespace

std::string VerdictSentence(const Discovery& discovery) {
  switch (discovery.verdict) {
    case Verdict::kAgrees:
      return fmt::format("Prediction and measurement agree: {} leave nothing but noise.",
                         StartOf(discovery));
    case Verdict::kExplained:
      return fmt::format("The gap between prediction and measurement is explained by {}.",
                         NamesOf(discovery));
    case Verdict::kPartlyExplained:
      return fmt::format(
          "The gap between prediction and measurement is explained in part, by {}; there is more "
          "than noise left.",
          NamesOf(discovery));
    case Verdict::kUndecided:
      break;
  }
  return "Prediction and measurement disagree, and these data do not say why.";
}

std::string VerdictMeaning(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAgrees:
      return "Nothing needs to be added to the model; what could still be hidden is listed with "
             "its size under 'What could not be seen'.";
    case Verdict::kExplained:
      return "With what was added, the model predicts poses that it has not seen about as well as "
             "the noise allows.";
    case Verdict::kPartlyExplained:
      return "The grown model predicts better than before, but not as well as the noise would "
             "allow.";
    case Verdict::kUndecided:
      break;
  }
  return "Base and tool are the best for these data, but their covariance does not hold what "
         "disagrees; other poses, or the missing columns that are named below, may decide.";
}

std::string CarriersOf(const DiscoveredEffect& found) {
  if (found.labels.size() == 6)
    for (const char* part : {"leg", "base joint", "platform joint"})
      if (found.labels.front() == fmt::format("{} 1", part)) return fmt::format("all {}s", part);
  if (!found.labels.empty()) return JoinWords(found.labels);
  return found.site.empty() ? "place unknown" : found.site;
}

std::vector<std::string> SizesOf(const DiscoveredEffect& found) {
  std::vector<std::string> lines;
  if (found.effect.name != kUnknownEffect)
    for (const auto& [what, words] : found.effect.found) lines.push_back(what + ": " + words);
  for (const EffectParameter& parameter : ParametersOf(found.effect, found.labels)) {
    if (parameter.numbers.size() > kMostNumbers) {
      lines.push_back(
          fmt::format("{}: {}, in model.yaml", parameter.name, parameter.numbers.size()));
      continue;
    }
    std::vector<std::string> numbers;
    for (const EffectNumber& number : parameter.numbers) {
      if (!IsShown(number)) continue;
      const std::string text = QuantityText(number.value, number.standard_deviation, number.unit);
      numbers.push_back(number.part.empty() ? text : number.part + " " + text);
    }
    if (!numbers.empty())
      lines.push_back(fmt::format("{}: {}", parameter.name, fmt::join(numbers, ", ")));
  }
  return lines;
}

std::vector<std::string> NoiseSentences(const NoiseFound& noise) {
  std::vector<std::string> lines;
  if (noise.scale != 1.0)
    lines.push_back(fmt::format("The tracker's noise is {:.3g} times the stated.", noise.scale));
  if (noise.robot_position > 0.0 || noise.robot_orientation > 0.0)
    lines.push_back(fmt::format("The robot's own repeatability is {} and {} (one sigma).",
                                SizeText(noise.robot_position, "m"),
                                SizeText(noise.robot_orientation, "rad")));
  if (noise.tail_freedom > 0.0)
    lines.push_back(
        fmt::format("Its tails are heavier than a Gaussian's: like Student's t with {:.3g} degrees "
                    "of freedom.",
                    noise.tail_freedom));
  if (noise.correlation != 0.0)
    lines.push_back(
        fmt::format("It is correlated by {:.2f} from one pose to the next.", noise.correlation));
  if (noise.shape_scale != 1.0)
    lines.push_back(
        fmt::format("Within their bodies the markers scatter {:.3g} times the stated "
                    "noise.",
                    noise.shape_scale));
  return lines;
}

std::string NameWithIndex(const std::string& name, const std::vector<int>& index) {
  if (index == std::vector<int>{1, 2, 3, 4, 5, 6}) return name + " (all six)";
  return index.empty() ? name : fmt::format("{} ({})", name, fmt::join(index, ", "));
}

bool IsKnown(const GapSize& size) {
  return std::isfinite(size.rms_position) &&
         (size.degrees_of_freedom > 0 || size.rms_position > 0.0);
}

std::string JoinWords(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace hexcal
