// SPDX-License-Identifier: BSD-3-Clause
#include "batch/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <random>

#include "estimator/observations.h"
#include "model/predict.h"
#include "model/simulate.h"
#include "report/digest.h"

namespace hexcal {
namespace {

void Scale(std::optional<PoseNoise>* noise, double factor) {
  if (!*noise) return;
  (*noise)->position *= factor;
  (*noise)->orientation *= factor;
}

Dataset WithNoise(Dataset dataset, double factor) {
  Scale(&dataset.robot_poses.noise, factor);
  if (dataset.robot_poses.leg_noise) *dataset.robot_poses.leg_noise *= factor;
  if (!dataset.measurement) return dataset;
  Scale(&dataset.measurement->pose_noise, factor);
  if (dataset.measurement->marker_sigma) *dataset.measurement->marker_sigma *= factor;
  return dataset;
}

// What an effect is linear in; a period or a phase stays what it is.
void ScaleEffect(Effect* effect, double factor) {
  const EffectKind* kind = FindEffectKind(effect->name);
  for (Eigen::Index k = 0; k < effect->parameters.size(); ++k) {
    if (kind != nullptr) {
      const ParameterKind& parameter = kind->ParameterOf(static_cast<int>(k));
      if (parameter.is_search || !parameter.acts_alone) continue;
    }
    effect->parameters[k] *= factor;
  }
}

Machine WithEffects(Machine machine, double factor) {
  if (factor == 0.0) {
    machine.effects.clear();
    machine.pose_map.reset();
  }
  for (Effect& effect : machine.effects) ScaleEffect(&effect, factor);
  if (machine.pose_map) machine.pose_map->coefficients *= factor;
  return machine;
}

// Of a dataset without a measurement: none.
std::vector<std::pair<int, Pose3d>> MeasuredPoses(const Dataset& dataset) {
  std::vector<std::pair<int, Pose3d>> measured;
  const bool has_readings = dataset.measurement && !(dataset.measurement->poses.empty() &&
                                                     dataset.measurement->readings.empty());
  if (!has_readings) return measured;
  std::size_t row = 0;
  for (const Observation& o : MakeObservations(dataset).items) {
    while (dataset.robot_poses.rows[row].label != o.label) ++row;
    measured.emplace_back(static_cast<int>(row), o.world_from_tool);
  }
  return measured;
}

// Results, messages among them, must not depend on where the files lie.
void SayInMessages(const std::string& scenario, Dataset* dataset) {
  dataset->path = scenario;
  dataset->robot_poses.where = FileLocation(scenario);
  dataset->measurement->where = FileLocation(scenario);
}

// Rows of a drawn subset, ascending.
std::vector<int> DrawRows(int rows, int count, std::uint64_t seed) {
  std::vector<int> all(rows);
  std::iota(all.begin(), all.end(), 0);
  std::mt19937_64 rng(seed);
  for (int i = 0; i < count; ++i)
    std::swap(all[i], all[i + std::uniform_int_distribution<int>(0, rows - i - 1)(rng)]);
  all.resize(count);
  std::sort(all.begin(), all.end());
  return all;
}

RobotPoses Restricted(const RobotPoses& from, const std::vector<int>& rows) {
  RobotPoses some = from;
  some.rows.clear();
  for (const int row : rows) some.rows.push_back(from.rows[row]);
  for (Covariate& covariate : some.covariates) {
    std::vector<double> values;
    for (const int row : rows) values.push_back(covariate.values[row]);
    covariate.values = std::move(values);
  }
  return some;
}

}  // namespace

int StudyCell::PosesADraw() const {
  return poses > 0 ? poses : static_cast<int>(dataset.robot_poses.rows.size());
}

StudyCell MakeStudyCell(const std::string& scenario,
                        const Dataset& dataset,
                        const Machine& truth,
                        const Dataset* test,
                        double noise,
                        int poses,
                        double effects,
                        bool knows_noise) {
  StudyCell cell;
  cell.scenario = scenario;
  cell.noise = noise;
  cell.poses = poses;
  cell.effects = effects;
  cell.knows_noise = knows_noise;
  cell.truth = WithEffects(truth, effects);
  cell.dataset = WithNoise(dataset, noise);
  cell.test = test != nullptr ? *test : dataset;
  cell.test_reported = ReportedPoses(cell.test);
  cell.test_true = Predict(cell.truth, cell.test);
  if (test != nullptr) cell.test_measured = MeasuredPoses(*test);
  if (cell.dataset.measurement) {  // a draw has readings of its own
    cell.dataset.measurement->poses.clear();
    cell.dataset.measurement->readings.clear();
  }
  cell.test.measurement.reset();
  MakeObservations(DrawDataset(cell, 1));  // refuses what is no use before anything is computed
  SayInMessages(scenario, &cell.dataset);
  return cell;
}

std::uint64_t SeedOf(const Study& study, std::int64_t task) {
  const std::string hash = Sha256(fmt::format("{} {} {}", study.name, study.seed, task));
  std::uint64_t seed = 0;
  std::from_chars(hash.data(), hash.data() + 16, seed, 16);
  return seed;
}

Dataset DrawDataset(const StudyCell& cell, std::uint64_t seed) {
  SimulateOptions options;
  options.seed = seed;
  options.quick = true;
  Dataset drawn = cell.poses > 0 ? [&] {
    Dataset some = cell.dataset;
    some.robot_poses = Restricted(
        cell.dataset.robot_poses,
        DrawRows(static_cast<int>(cell.dataset.robot_poses.rows.size()), cell.poses, seed));
    return Simulate(some, cell.truth, options);
  }()
                                 : Simulate(cell.dataset, cell.truth, options);
  if (!cell.knows_noise) {
    drawn.measurement->pose_noise.reset();
    drawn.measurement->marker_sigma.reset();
  }
  return drawn;
}

}  // namespace hexcal
