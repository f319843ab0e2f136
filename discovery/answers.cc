// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/answers.h"

#include <fmt/format.h>

#include <cmath>

#include "model/described_effect.h"

namespace hexcal {
namespace {

const FormDefinition& FirstOf(const FormLibrary& library, int family) {
  for (const FormDefinition& form : library.forms)
    if (form.family == family) return form;
  return library.forms.front();
}

template <typename Read>
std::vector<std::string> Each(const FormLibrary& library, const Read& read) {
  std::vector<std::string> words;
  for (std::size_t f = 0; f < library.families.size(); ++f)
    words.push_back(read(FirstOf(library, static_cast<int>(f)).effect));
  return words;
}

std::string LabelOf(const Effect& effect,
                    const EffectKind* kind,
                    int index,
                    const Dataset& dataset) {
  const std::string site = kind != nullptr ? std::string(kind->site) : effect.found.at("site");
  if (site == "marker" || effect.name == "swapped_markers") {
    const auto& bodies = dataset.measurement->bodies;
    const int in_base = static_cast<int>(bodies[0].markers.size());
    const int marker = index - 1;
    return marker < in_base ? "base/" + bodies[0].markers[marker]
                            : "tool/" + bodies[1].markers[marker - in_base];
  }
  if (site == "base_joint") return fmt::format("base joint {}", index);
  if (site == "platform_joint") return fmt::format("platform joint {}", index);
  return fmt::format("leg {}", index);
}

std::string ShapeOf(const Effect& effect) {
  if (IsPoseMap(effect))
    return effect.reference.at("degree")[0] == 1.0 ? "linear map" : "quadratic map";
  const double power = effect.reference.at("power")[0];
  return power == 1.0 ? "linear" : power == 2.0 ? "quadratic" : "cubic";
}

std::string Sentence(const DiscoveredEffect& answer,
                     const EffectKind* kind,
                     const Dataset& dataset) {
  if (kind == nullptr)
    return fmt::format("Something at the {} that follows {} ({}); a description, not a cause.",
                       answer.site,
                       answer.driver,
                       answer.shape);
  std::string text(kind->cause);
  const bool has_base_markers =
      dataset.measurement && dataset.measurement->kind == Measurement::Kind::kMarkers;
  if (answer.effect.name.rfind("base_drift", 0) == 0 && !has_base_markers)
    text += " A tracker that moves looks the same where no base markers are measured.";
  return text;
}

}  // namespace

std::vector<std::string> SitesOf(const FormLibrary& library) {
  return Each(library, [](const Effect& effect) {
    const EffectKind* kind = FindEffectKind(effect.name);
    return kind != nullptr ? std::string(kind->site) : effect.found.at("site");
  });
}

std::vector<std::string> DriversOf(const FormLibrary& library) {
  return Each(library, [](const Effect& effect) {
    const EffectKind* kind = FindEffectKind(effect.name);
    return kind != nullptr ? std::string(kind->driver) : effect.found.at("driver");
  });
}

std::vector<std::string> UnitsOf(const FormLibrary& library) {
  std::vector<std::string> units;
  for (std::size_t f = 0; f < library.families.size(); ++f) {
    const FormDefinition& form = FirstOf(library, static_cast<int>(f));
    const EffectKind* kind = FindEffectKind(form.effect.name);
    Eigen::Index number = 0;
    if (form.directions.size() > 0) form.directions.col(0).maxCoeff(&number);
    units.emplace_back(kind != nullptr ? kind->UnitOf(static_cast<int>(number)) : "m");
  }
  return units;
}

DiscoveredEffect AnswerFor(const Effect& effect, const Dataset& dataset) {
  DiscoveredEffect answer;
  answer.effect = effect;
  const EffectKind* kind = FindEffectKind(effect.name);
  if (kind != nullptr) {
    answer.site = kind->site, answer.driver = kind->driver, answer.shape = kind->shape;
  } else {
    answer.site = effect.found.at("site"), answer.driver = effect.found.at("driver");
    answer.shape = ShapeOf(effect);
  }
  for (const int index : effect.index)
    answer.labels.push_back(LabelOf(effect, kind, index, dataset));
  answer.description = Sentence(answer, kind, dataset);
  return answer;
}

}  // namespace hexcal
