// SPDX-License-Identifier: BSD-3-Clause
#include "model/machine_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/described_effect.h"

namespace hexcal {
namespace {

bool IsOfTrackerOrMarkers(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  return kind != nullptr && (kind->site == "tracker" || kind->site == "marker");
}

std::vector<Effect> Acting(const std::vector<Effect>& effects, EffectSites sites) {
  std::vector<Effect> acting = effects;
  if (sites == EffectSites::kRobotAndMounts)
    acting.erase(std::remove_if(acting.begin(), acting.end(), IsOfTrackerOrMarkers), acting.end());
  return acting;
}

[[noreturn]] void ThrowLacks(const Dataset& dataset, const Effect& effect, std::string_view what) {
  throw InputError(FileLocation(dataset.path),
                   fmt::format("a dataset without {}", what),
                   fmt::format("what the model's effect '{}' needs", effect.name));
}

// Markers are counted across both bodies: with other bodies the numbers mean others.
void RequireMarkers(const Dataset& dataset, const Effect& effect) {
  const auto asked = effect.reference.find("markers");
  if (asked == effect.reference.end()) return;
  for (int body = 0; body < 2; ++body) {
    const auto count = static_cast<double>(dataset.measurement->bodies[body].markers.size());
    if (count != asked->second[body])
      ThrowLacks(dataset,
                 effect,
                 fmt::format("{} markers on the {} body (it has {})",
                             asked->second[body],
                             body == 0 ? "base" : "tool",
                             count));
  }
}

bool HasCovariate(const Dataset& dataset, const std::string& name) {
  const std::vector<Covariate>& all = dataset.robot_poses.covariates;
  return std::any_of(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
}

// Of a description that stands in for an effect without a name.
void RequireDriver(const Dataset& dataset, const Drivers& drivers, const Effect& unknown) {
  const auto driver = unknown.found.find("driver");
  if (driver == unknown.found.end() || unknown.parameters.size() == 0) return;
  if (driver->second == "temperature" && !drivers.temperature)
    ThrowLacks(dataset, unknown, "a temperature column");
  if (driver->second == "payload" && !drivers.payload)
    ThrowLacks(dataset, unknown, "a payload column");
  if (!IsDriverName(driver->second) && !HasCovariate(dataset, driver->second))
    ThrowLacks(dataset, unknown, fmt::format("a {} column", driver->second));
  const bool is_of_legs = driver->second == "leg_length" || unknown.found.at("site") == "leg";
  if (is_of_legs && !drivers.legs)
    ThrowLacks(dataset, unknown, "a hexapod with base_joints and platform_joints");
}

void RequireDrivers(const Dataset& dataset,
                    const HexapodGeometry* hexapod,
                    const std::vector<Effect>& effects) {
  Drivers drivers = DriversOf(dataset);
  drivers.legs = hexapod != nullptr;
  drivers.order = true;  // one row alone comes from the centre of the travel
  for (const Effect& effect : effects) {
    const EffectKind* kind = FindEffectKind(effect.name);
    if (kind == nullptr) {
      RequireDriver(dataset, drivers, effect);
      continue;
    }
    const std::string missing = MissingFor(*kind, drivers);
    if (!missing.empty()) ThrowLacks(dataset, effect, missing);
    const auto is_row = effect.reference.find("time_is_row");
    if (is_row != effect.reference.end() && is_row->second[0] == 0.0 && !drivers.time)
      ThrowLacks(dataset, effect, "a time column");
    if (drivers.markers) RequireMarkers(dataset, effect);
  }
}

}  // namespace

const HexapodGeometry* HexapodOf(const Dataset& dataset, const Machine& machine) {
  if (machine.hexapod) return &*machine.hexapod;
  return dataset.hexapod ? &*dataset.hexapod : nullptr;
}

MachineRows::MachineRows(const Dataset& dataset,
                         const Machine& machine,
                         const std::vector<Pose3d>& reported,
                         EffectSites sites)
    : dataset_(dataset),
      machine_(machine),
      hexapod_(HexapodOf(dataset, machine)),
      effects_(Acting(machine.effects, sites)),
      // Without an effect nobody asks where the legs are.
      visits_(dataset, effects_.empty() ? nullptr : hexapod_, reported) {
  RequireDrivers(dataset, hexapod_, effects_);
}

MachineRows::Row MachineRows::Next() {
  Row row;
  row.visit = visits_.Next();
  row.corrections = CorrectionsOf(effects_, row.visit);
  if (machine_.pose_map)
    row.corrections.platform_twist +=
        PoseMapTwist(*machine_.pose_map, row.visit.base_from_platform);
  return row;
}

ForwardPose MachineRows::Forward(const Row& row) const {
  const ForwardPose pose = hexcal::Forward({machine_.world_from_base, machine_.platform_from_tool},
                                           hexapod_,
                                           row.visit,
                                           row.corrections);
  if (pose.reached) return pose;
  const RobotPoses& robot_poses = dataset_.robot_poses;
  Location where = robot_poses.where;
  where.line = robot_poses.rows[row.visit.row].line;
  where.column = 0;
  throw InputError(where,
                   fmt::format("pose '{}', whose legs with the model's effects reach no pose",
                               robot_poses.rows[row.visit.row].label),
                   "a pose inside the workspace of the model's hexapod");
}

}  // namespace hexcal
