// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/trial.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "hidden/as_dataset.h"
#include "hidden/pose_fit.h"
#include "measurement/tool_pose.h"
#include "model/predict.h"

namespace hexcal::hidden {
namespace {

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Of this thread: other trials run beside it.
double ProcessorSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<std::string> Sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> NamesOf(const std::vector<Found>& found) {
  std::vector<std::string> names;
  for (const Found& entry : found) names.push_back(entry.name);
  return Sorted(names);
}

double HeldoutRms(const Case& made, const Machine& machine, const Dataset& dataset) {
  const std::vector<Pose3d> predicted = Predict(machine, dataset);
  double square = 0.0;
  int rows = 0;
  for (std::size_t i = 0; i < made.scene.rows.size(); ++i) {
    const Row& row = made.scene.rows[i];
    if (row.is_measured) continue;
    const Motion tool = TrueTool(made.scene, row, Sum(made.effects, made.scene, row));
    square += (predicted[i].translation - tool.shift).squaredNorm();
    ++rows;
  }
  return std::sqrt(square / rows);
}

// Root mean square of a measured tool's position.
double MeasuredNoise(const Dataset& dataset) {
  double sum = 0.0;
  const ToolPoses tools = ComputeToolPoses(dataset);
  for (const ToolPose& tool : tools.poses) sum += tool.covariance.topLeftCorner<3, 3>().trace();
  return std::sqrt(sum / static_cast<double>(tools.poses.size()));
}

void JudgeHeldout(const Case& made, const Discovery& discovery, Trial* trial) {
  Dataset dataset = AsDataset(made);
  trial->noise = MeasuredNoise(dataset);
  dataset.measurement.reset();
  Machine mounts;
  mounts.world_from_base = discovery.base_and_tool.mounts.world_from_base;
  mounts.platform_from_tool = discovery.base_and_tool.mounts.platform_from_tool;
  trial->before = HeldoutRms(made, mounts, dataset);
  trial->after = HeldoutRms(made, discovery.machine, dataset);
  trial->oracle =
      HeldoutRms(FitMounts(made.scene, made.effects, made.readings), made.scene, made.effects);
}

void Note(const Discovery& discovery, Trial* trial) {
  trial->verdict = NameOf(discovery.verdict);
  if (!discovery.steps.empty()) trial->first_p = discovery.steps[0].p_value;
  for (const DiscoveredEffect& effect : discovery.effects) {
    Found found{effect.effect.name, effect.effect.index, {}, effect.p_value};
    for (const Rival& rival : effect.could_also_be) found.could_also_be.push_back(rival.name);
    trial->found.push_back(found);
  }
}

}  // namespace

bool Found::Covers(const std::string& other) const {
  return name == other || Has(could_also_be, other);
}

bool Trial::NamesFirst() const {
  return !found.empty() && !truth.empty() && found[0].name == truth[0];
}

bool Trial::ClassIsRight() const {
  return !found.empty() && !truth.empty() && found[0].Covers(truth[0]);
}

bool Trial::SetIsExact() const { return NamesOf(found) == Sorted(truth); }

bool Trial::SetIsInClasses() const {
  if (found.size() != truth.size()) return false;
  return std::all_of(truth.begin(), truth.end(), [&](const std::string& wanted) {
    return std::any_of(
        found.begin(), found.end(), [&](const Found& entry) { return entry.Covers(wanted); });
  });
}

bool Trial::AddsWrong() const {
  return std::any_of(found.begin(), found.end(), [&](const Found& entry) {
    return std::none_of(truth.begin(), truth.end(), [&](const std::string& wanted) {
      return entry.Covers(wanted);
    });
  });
}

bool Trial::HasCarrier() const {
  return NamesFirst() && carriers.size() == 1 &&
         std::count(found[0].index.begin(), found[0].index.end(), carriers[0]) > 0;
}

bool Trial::HasCarrierAlone() const { return HasCarrier() && found[0].index.size() == 1; }

bool Trial::IsUnknownOrRightSite() const {
  return !found.empty() && (found[0].Covers("unknown") ||
                            std::any_of(right.begin(), right.end(), [&](const std::string& wanted) {
                              return found[0].Covers(wanted);
                            }));
}

bool Trial::IsConfidentlyWrong() const {
  return !found.empty() && found[0].could_also_be.empty() && !IsUnknownOrRightSite();
}

bool Trial::IsWrong() const { return !found.empty() && !IsUnknownOrRightSite(); }

bool Trial::IsWorse() const { return after > 1.02 * before; }

bool Trial::IsWorseAsMeasured() const {
  return std::hypot(after, noise) > 1.02 * std::hypot(before, noise);
}

double Trial::GapClosed() const {
  const double gap = before * before - oracle * oracle;
  if (!(before * before > 1.5 * oracle * oracle)) return std::numeric_limits<double>::quiet_NaN();
  return (before * before - after * after) / gap;
}

Trial RunTrial(const std::string& cell,
               const Case& made,
               const DiscoverOptions& options,
               bool as_poses) {
  Trial trial;
  trial.cell = cell;
  trial.name = made.name;
  for (const HiddenEffect& effect : made.effects) {
    trial.truth.push_back(effect.name);
    trial.is_listed &= effect.is_listed;
  }
  if (!made.effects.empty()) {
    trial.right = made.effects[0].right;
    trial.carriers = made.effects[0].carriers;
  }
  Dice dice(99, made.readings.size());
  const Dataset dataset = as_poses ? AsPoseDataset(made, &dice) : AsDataset(made);
  try {
    const double start = ProcessorSeconds();
    const Discovery discovery = Discover(dataset, options);
    trial.seconds = ProcessorSeconds() - start;
    Note(discovery, &trial);
    if (!as_poses) JudgeHeldout(made, discovery, &trial);
  } catch (const std::exception& error) {
    trial.error = error.what();
  }
  return trial;
}

}  // namespace hexcal::hidden
