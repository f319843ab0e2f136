// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/experiments.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace hexcal {
namespace {

constexpr std::string_view kMovingTracker = "a tracker that moves";
constexpr std::string_view kWholeBody = "the whole body of markers, moved";

// An experiment that changes what drives some effects, or looks at what they act on, and nothing
// else.
struct Experiment {
  std::vector<std::string_view> sites;    // of the table of effects; empty: any
  std::vector<std::string_view> drivers;  // likewise
  std::string_view text;
  std::string_view between;  // two effects of this kind; empty: text
};

// Of two rivals, the experiment that stands first: it needs the least beside the robot. Every
// effect of the table has one.
const std::array<Experiment, 8>& Experiments() {
  static const std::array<Experiment, 8> experiments = {{
      {{},
       {"leg_force", "platform position × payload", "gravity seen from the platform"},
       "hold one pose and change the load alone: several loads, also off the centre, and none",
       ""},
      {{},
       {"temperature"},
       "hold one pose and take the temperature up and down again",
       "hold one pose and warm one part alone: the legs, a plate, the tool"},
      {{},
       {"leg_direction", "last move"},
       "reach one pose again and again from both sides, and wait for several times before reading",
       ""},
      {{}, {"velocity"}, "read one pose at rest and at several speeds, both ways", ""},
      {{"tracker"},
       {},
       "put a certified length bar into the tracker's volume, or read the single markers of bodies "
       "whose sizes are certified (kind: markers)",
       "repeat the poses from a second place of the tracker, or put a certified length bar into "
       "its volume"},
      {{},
       {"time"},
       "come back to one pose every ten, and leave a reference target on the base in view",
       ""},
      {{"marker"}, {}, "measure the body's markers on a coordinate measuring machine", ""},
      {{"leg", "base_joint", "platform_joint", "base_joint or platform_joint"},
       {},
       "measure the joint circles on a coordinate measuring machine, or one leg's length with a "
       "gauge over its travel",
       ""},
  }};
  return experiments;
}

bool Has(const std::vector<std::string_view>& words, std::string_view word) {
  return words.empty() || std::find(words.begin(), words.end(), word) != words.end();
}

// Its place in the list; behind all: no effect of the table, or one for which there is none.
std::size_t ExperimentOf(const std::string& effect) {
  const EffectKind* kind = FindEffectKind(effect);
  std::size_t k = 0;
  for (const Experiment& experiment : Experiments()) {
    if (kind != nullptr && Has(experiment.sites, kind->site) &&
        Has(experiment.drivers, kind->driver))
      return k;
    ++k;
  }
  return k;
}

// All markers of one body.
bool CoversABody(const Effect& effect, const Measurement& measurement) {
  int first = 1;
  for (const MarkerBody& body : measurement.bodies) {
    const int last = first + static_cast<int>(body.markers.size());
    int count = 0;
    for (int marker = first; marker < last; ++marker)
      count += static_cast<int>(std::count(effect.index.begin(), effect.index.end(), marker));
    if (count > 0 && count == last - first) return true;
    first = last;
  }
  return false;
}

}  // namespace

std::vector<Gauge> GaugesOf(const Effect& effect, const Dataset& dataset) {
  const bool by_poses =
      dataset.measurement && dataset.measurement->kind == Measurement::Kind::kPoses;
  const bool sees_base = !by_poses && !dataset.tracker.is_static;
  std::vector<Gauge> gauges;
  if (by_poses && effect.name == "tracker_scale")
    // A gain about the centre of the travel is one about zero with an offset of each leg.
    gauges.push_back({"base_radius with platform_radius and leg_gain",
                      {{"base_radius"}, {"platform_radius"}, {"leg_gain"}, {"leg_offset", true}}});
  if (!sees_base && (effect.name == "base_drift" || effect.name == "base_step"))
    gauges.push_back({std::string(kMovingTracker), {}});
  if (!by_poses && effect.name == "marker_offset" && CoversABody(effect, *dataset.measurement))
    gauges.push_back({std::string(kWholeBody), {}});
  return gauges;
}

std::string ExperimentFor(const std::string& effect, const std::string& rival) {
  if (rival == kMovingTracker)
    return "measure markers on the base in every pose (static: false), or a target on the floor "
           "beside it";
  if (rival == kWholeBody)
    return "measure the body's markers on a coordinate measuring machine; for predictions the two "
           "are the same";
  const std::size_t one = ExperimentOf(effect), other = ExperimentOf(rival);
  const std::size_t first = std::min(one, other);
  if (first == Experiments().size())
    return "vary what drives it independently of the pose, of time and of all else";
  const Experiment& experiment = Experiments()[first];
  const bool is_between = one == other && !experiment.between.empty();
  return std::string(is_between ? experiment.between : experiment.text);
}

}  // namespace hexcal
