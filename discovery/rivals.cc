// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/rivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "discovery/score.h"

namespace hexcal {
namespace {

// 2 ln of the Bayes factor: below it the rival is as good as the winner (posterior some 1 in 20).
constexpr double kClose = 6.0;
// Squared distance of two effects in sigmas below which the wrong one wins more than 1 in 20
// times; it counts where the data have not already decided clearly.
constexpr double kInseparable = 10.8;
constexpr double kDecided = 16.0;

bool IsOneOf(const std::string& name, const std::set<std::string>& names) {
  return names.count(name) > 0;
}
const std::set<std::string> kOverTime = {"base_drift",
                                         "tool_drift",
                                         "base_step",
                                         "tool_step",
                                         "tracker_warmup",
                                         "leg_thermal",
                                         "tool_thermal",
                                         "plate_thermal"};
const std::set<std::string> kGeometry = {"leg_offset",
                                         "base_joint_offset",
                                         "base_radius",
                                         "platform_joint_offset",
                                         "platform_radius",
                                         "joint_axis_offset",
                                         "leg_gain",
                                         "leg_nonlinearity"};
const std::set<std::string> kTracker = {
    "tracker_scale", "tracker_depth_scale", "tracker_distortion", "marker_offset", "marker_shift"};
const std::set<std::string> kLoad = {"leg_compliance", "leg_clearance", "base_flexure", "tool_sag"};

// Nothing that kind poses holds can tell these apart.
void AddGauges(const std::string& name, std::vector<Rival>* rivals) {
  const auto add = [&](const std::string& rival) {
    const std::string why =
        "exactly the same in measured poses: a tracker that scales is a hexapod whose two circles "
        "and legs are all larger; readings of single markers, or a certified length, tell";
    for (Rival& present : *rivals)
      if (present.name == rival) {
        present.why = why;
        return;
      }
    rivals->push_back({rival, why});
  };
  if (name == "tracker_scale")
    for (const char* rival : {"base_radius", "platform_radius", "leg_gain"}) add(rival);
}

}  // namespace

std::string WhatTellsApart(const std::string& name, const std::string& rival) {
  const std::set<std::string> both = {name, rival};
  if (IsOneOf(name, kOverTime) && IsOneOf(rival, kOverTime)) {
    const bool base_and_tool = (name[0] == 'b') != (rival[0] == 'b') &&
                               (name.rfind("base", 0) == 0 || name.rfind("tool", 0) == 0);
    if (base_and_tool)
      return "poses with larger rotations, in an order unlike that of time, or a reference target "
             "that stays in view";
    return "poses in random order, revisited ones, and a temperature that goes up and down";
  }
  if (IsOneOf(name, kGeometry) && IsOneOf(rival, kGeometry))
    return "poses in the corners of the workspace, a coordinate measuring machine on the joint "
           "circles, or a gauge on a leg";
  if (IsOneOf(name, kTracker) && IsOneOf(rival, kTracker))
    return "the same poses from another place of the tracker, or a length bar in its volume";
  if (IsOneOf(name, kLoad) || IsOneOf(rival, kLoad))
    return "the same poses with several loads, also off the centre, and with none";
  return "more poses, spread over the whole workspace, with drivers varied independently";
}

std::vector<std::vector<Rival>> RivalsOf(const LinearProblem& problem,
                                         const GapNoise& noise,
                                         const std::vector<int>& chosen,
                                         bool kind_poses) {
  std::vector<std::vector<Rival>> all;
  if (chosen.empty()) return all;
  const Scorer alone(problem, noise);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    std::vector<int> others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const Scorer scorer = alone.Given(others);
    const std::vector<Scorer::FamilyScore> families = scorer.Families();
    const int family = problem.forms[chosen[k]].family;
    const std::string& name = problem.families[family].name;
    double evidence = 0.0;
    for (const auto& score : families)
      if (score.family == family) evidence = score.evidence;
    const double gain = scorer.scores()[chosen[k]].gain;

    std::vector<Rival> rivals;
    for (const auto& rival : families) {
      if (rival.family == family) continue;
      const double behind = evidence - rival.evidence;
      if (behind > kDecided) continue;
      const double explained = scorer.Explained(chosen[k], rival.best.form);
      const double apart = gain * (1.0 - explained);
      if (behind > kClose && apart > kInseparable) continue;
      const Family& other = problem.families[rival.family];
      const std::string shown = other.is_described ? "unknown" : other.name;
      const bool is_there = std::any_of(
          rivals.begin(), rivals.end(), [&](const Rival& r) { return r.name == shown; });
      if (is_there) continue;
      rivals.push_back(
          {shown,
           fmt::format("{}explains {:.0f} % of it, evidence {:.1f} behind; to tell them apart: {}",
                       other.is_described ? "a description (" + other.name + ") " : "",
                       100.0 * explained,
                       behind,
                       WhatTellsApart(name, other.name))});
    }
    if (kind_poses) AddGauges(name, &rivals);
    all.push_back(std::move(rivals));
  }
  return all;
}

}  // namespace hexcal
