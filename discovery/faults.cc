// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/faults.h"

#include <glog/logging.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "estimator/calibrate.h"
#include "model/data_fault.h"
#include "model/machine.h"
#include "model/predict.h"

namespace hexcal {
namespace {

// Some 60 alternatives are tried; an effect of another kind may lend one of them a little.
constexpr double kClear = 40.0;

Effect Fault(const std::string& name) {
  Effect effect;
  effect.name = name;
  effect.parameters.resize(0);
  return effect;
}

std::vector<Effect> Alternatives(const Dataset& dataset) {
  std::vector<Effect> all;
  const bool has_poses = !dataset.robot_poses.are_leg_lengths;
  if (has_poses) {
    for (const char* order : {"xzy", "yxz", "yzx", "zxy", "zyx"}) {
      all.push_back(Fault("wrong_rotation_order"));
      all.back().found["order"] = order;
    }
    all.push_back(Fault("transposed_rotation"));
    all.push_back(Fault("wrong_quaternion_order"));
  }
  if (dataset.hexapod)
    for (int a = 0; a < kNumLegs; ++a)
      for (int b = a + 1; b < kNumLegs; ++b) {
        std::vector<double> permutation = {1, 2, 3, 4, 5, 6};
        std::swap(permutation[a], permutation[b]);
        all.push_back(Fault("swapped_legs"));
        all.back().index = {a + 1, b + 1};
        all.back().reference["permutation"] = permutation;
      }
  for (const double rows : {-3.0, -2.0, -1.0, 1.0, 2.0, 3.0}) {
    all.push_back(Fault("shifted_rows"));
    all.back().reference["rows"] = {rows};
  }
  const auto unit = [&](const char* of, double factor) {
    all.push_back(Fault("wrong_unit"));
    all.back().found["of"] = of;
    all.back().reference["factor"] = {factor};
  };
  for (const double factor : {1e3, 1e-3, 10.0, 0.1, 25.4, 1.0 / 25.4}) unit("lengths", factor);
  if (has_poses)
    for (const double factor : {M_PI / 180.0, 180.0 / M_PI}) unit("angles", factor);
  return all;
}

// -2 ln of the likelihood, but for what is the same for all: both noise levels at their best.
double Deviance(Observations observations) {
  observations.tool_noise_is_known = false;
  observations.has_robot_noise = false;
  CalibrateOptions options;
  const Estimate estimate = Calibrate(observations, std::nullopt, options);
  if (!(estimate.noise.position > 0.0) || !(estimate.noise.orientation > 0.0))
    return std::numeric_limits<double>::infinity();
  const double rows = 3.0 * static_cast<double>(observations.items.size());
  return 2.0 * rows * (std::log(estimate.noise.position) + std::log(estimate.noise.orientation));
}

}  // namespace

std::optional<FaultFound> FindFault(const Dataset& dataset, const Observations& observations) {
  std::map<std::string, std::size_t> row_of;
  for (std::size_t i = 0; i < dataset.robot_poses.rows.size(); ++i)
    row_of[dataset.robot_poses.rows[i].label] = i;
  const double plain = Deviance(observations);
  std::optional<FaultFound> best;
  for (const Effect& effect : Alternatives(dataset)) {
    Machine machine;
    machine.hexapod = dataset.hexapod;
    machine.effects = {effect};
    std::vector<Pose3d> reported;
    try {
      reported = ReportedPoses(dataset, machine);
    } catch (const InputError&) {
      continue;  // legs in these places reach no pose: not this fault
    }
    Observations mended = observations;
    for (Observation& item : mended.items) item.base_from_platform = reported[row_of[item.label]];
    const double gain = plain - Deviance(std::move(mended));
    if (gain > kClear && (!best || gain > best->gain)) best = FaultFound{effect, gain};
  }
  return best;
}

}  // namespace hexcal
