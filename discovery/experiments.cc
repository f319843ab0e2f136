// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/experiments.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace hexcal {
namespace {

constexpr std::string_view kConstant = "constant";  // of the table's drivers
constexpr std::string_view kMovingTracker = "a tracker that moves";
constexpr std::string_view kWholeBody = "the whole body of markers, moved";

// What an experiment changes, by what it acts on. The first group in which both rivals stand
// decides; a rival outside the table is in none.
struct Group {
  std::vector<std::string_view> members;
  std::string_view experiment;
};

const std::array<Group, 6>& Groups() {
  static const std::array<Group, 6> groups = {{
      {{"leg_offset",
        "leg_gain",
        "leg_nonlinearity",
        "base_joint_offset",
        "platform_joint_offset",
        "base_radius",
        "platform_radius",
        "joint_axis_offset",
        "leg_screw_rotation"},
       "measure the joint circles on a coordinate measuring machine, or one leg's length with a "
       "gauge over its travel"},
      {{"leg_compliance", "leg_clearance", "base_flexure", "tool_sag"},
       "hold the pose and change the load alone: several loads, also off the centre, and none"},
      {{"tracker_scale",
        "tracker_depth_scale",
        "tracker_distortion",
        "marker_offset",
        "marker_shift"},
       "repeat the poses from a second place of the tracker, or put a certified length bar into "
       "its volume"},
      {{"leg_thermal", "plate_thermal", "tool_thermal"},
       "warm one part alone (a heating pad on a leg, on a plate, on the tool) in one pose"},
      {{"base_drift", "tool_drift", "base_step", "tool_step", "tracker_warmup", "marker_shift"},
       "leave a reference target on the base in view, and come back to one pose every ten"},
      {{"leg_backlash", "latency", "settling"},
       "measure one pose again and again, reached from both sides, at several speeds and after "
       "several waits"},
  }};
  return groups;
}

bool Has(const Group& group, std::string_view name) {
  return std::find(group.members.begin(), group.members.end(), name) != group.members.end();
}

bool IsTracker(std::string_view name) { return name.rfind("tracker", 0) == 0; }

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

std::string DriverOf(const std::string& name) {
  const EffectKind* kind = FindEffectKind(name);
  return kind == nullptr ? "what drives " + name : std::string(kind->driver);
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
  for (const Group& group : Groups())
    if (Has(group, effect) && Has(group, rival)) return std::string(group.experiment);
  if (IsTracker(effect) || IsTracker(rival))
    return "read the single markers of bodies whose sizes are certified (kind: markers), or put a "
           "certified length bar into the tracker's volume";
  const std::string one = DriverOf(effect), other = DriverOf(rival);
  if (one == other) return "measure the part that " + effect + " blames by itself, off the robot";
  // What is constant cannot be changed; only the other one follows its driver.
  if (one == kConstant || other == kConstant)
    return "hold the pose and change the " + (one == kConstant ? other : one) + " alone";
  return "hold the pose and change the " + one + " while the " + other +
         " stays, then the other way round";
}

}  // namespace hexcal
