// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_given.h"

#include <fmt/format.h>

#include "report/discovery_words.h"
#include "report/effect_json.h"
#include "report/quantity.h"

namespace hexcal {

std::string StartOf(const Discovery& discovery) {
  return discovery.given.empty() ? "base and tool alone" : "base, tool and what was given";
}

std::string SentenceOf(const GivenEffect& given) {
  if (!given.judgement) return "taken as the model has it.";
  const GivenJudgement& judgement = *given.judgement;
  switch (judgement.state) {
    case GivenState::kConfirmed:
      return fmt::format("confirmed: without it numbers as large have a probability of {}.",
                         ProbabilityText(judgement.p_absent));
    case GivenState::kChanged:
      return fmt::format(
          "there, but other than in the model: with the model's numbers these have a probability "
          "of {}.",
          ProbabilityText(judgement.p_unchanged));
    case GivenState::kNotSupported:
      break;
  }
  return fmt::format(
      "NOT supported by these data: numbers as large appear with a probability of {} where the "
      "effect is not there.",
      ProbabilityText(judgement.p_absent));
}

void AddGiven(const Discovery& discovery, HtmlPage* page) {
  if (discovery.given.empty()) return;
  page->Section("What was given");
  page->Paragraph(
      "The effects of the model that the search was started from, fitted along with base and tool "
      "and whatever was found. Where this report says before, they are in already.");
  HtmlTable table = {{{"effect"}, {"where"}, {"as these data have it"}, {"what they say of it"}},
                     {}};
  for (const GivenEffect& given : discovery.given) {
    std::string sizes;
    for (const std::string& line : SizesOf(given.now)) sizes += (sizes.empty() ? "" : "; ") + line;
    table.rows.push_back({given.now.effect.name, CarriersOf(given.now), sizes, SentenceOf(given)});
  }
  page->Table(table);
}

nlohmann::ordered_json JsonGiven(const Discovery& discovery) {
  auto list = nlohmann::ordered_json::array();
  for (const GivenEffect& given : discovery.given) {
    nlohmann::ordered_json one = JsonEffect(given.now.effect);
    one["labels"] = given.now.labels;
    one["state"] = given.judgement ? std::string(NameOf(given.judgement->state)) : "held";
    one["p_absent"] = given.judgement ? nlohmann::ordered_json(given.judgement->p_absent) : nullptr;
    one["p_unchanged"] =
        given.judgement ? nlohmann::ordered_json(given.judgement->p_unchanged) : nullptr;
    list.push_back(one);
  }
  return list;
}

}  // namespace hexcal
