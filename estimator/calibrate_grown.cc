// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate_grown.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimator/free_effect.h"
#include "estimator/grown_fit.h"
#include "measurement/tool_pose.h"
#include "model/data_fault.h"
#include "model/machine_rows.h"
#include "model/predict.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

constexpr double kPriorWidths = 3.0;
constexpr int kRounds = 3;  // of noise and fit, where no noise is stated

bool IsOfTrackerOrMarkers(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  return kind != nullptr && (kind->site == "tracker" || kind->site == "marker");
}

class Grower {
 public:
  Grower(const Dataset& dataset, const Machine& model, const CalibrateOptions& options)
      : dataset_(dataset),
        model_(model),
        hexapod_(HexapodOf(dataset, model)),
        observations_(MakeObservations(dataset)) {
    options_.noise = options.noise;
    options_.threads = options.threads;
    options_.start = Start::kInitial;
    const std::vector<Pose3d> reported = ReportedPoses(dataset, model);
    MachineRows machine_rows(dataset, model, reported, EffectSites::kAll);
    for (std::size_t i = 0; i < reported.size(); ++i) visits_.push_back(machine_rows.Next().visit);
    for (const ToolPose& pose : ComputeToolPoses(dataset).poses) rows_.push_back(pose.pose);
    CHECK_EQ(rows_.size(), observations_.items.size());
    home_ = HomePose(hexapod_, reported);
  }

  GrownCalibration Run() {
    fit_.mounts = {model_.world_from_base, model_.platform_from_tool};
    fit_.effects = model_.effects;
    GrownCalibration result;
    // The first look is through the model as it is, with base and tool wherever they are now.
    result.estimate = Calibrate(Cleaned(Look()), std::nullopt, Plain());
    const BaseAndTool& now = result.estimate.mounts;
    fit_.mounts = {now.world_from_base, now.platform_from_tool};
    const bool is_stated = observations_.tool_noise_is_known || options_.noise.has_value();
    for (int round = 0; round < (is_stated ? 1 : kRounds); ++round) {
      fit_ = FitGrown(Problem(result.estimate), fit_.mounts, {}, {});
      result.estimate = Calibrate(Cleaned(fit_), MountsOfFit(), options_);
    }
    Finish(&result.estimate);
    result.machine = Grown();
    return result;
  }

 private:
  CalibrateOptions Plain() const {
    CalibrateOptions plain = options_;
    plain.start = Start::kClosedForm;
    return plain;
  }

  BaseAndTool MountsOfFit() const {
    return {fit_.mounts.world_from_base, fit_.mounts.platform_from_tool};
  }

  // What the model as it is predicts and sees.
  GrownFit Look() const {
    GrownProblem::Data data = DataOf({});
    const GrownProblem problem(std::move(data), Held());
    GrownFit look = fit_;
    const auto evaluation = problem.Evaluate(fit_.mounts, Eigen::VectorXd(), false);
    if (!evaluation)
      throw InputError(dataset_.robot_poses.where,
                       "poses that the model's effects put out of the legs' reach",
                       "poses inside the workspace of the model's hexapod");
    look.predicted = evaluation->predicted;
    look.seen = evaluation->seen;
    return look;
  }

  // Poses without the effects: the platform where it must be for the mounts alone to predict as
  // much.
  Observations Cleaned(const GrownFit& fit) const {
    Observations cleaned = observations_;
    for (std::size_t i = 0; i < cleaned.items.size() && i < fit.predicted.size(); ++i) {
      cleaned.items[i].base_from_platform = fit.mounts.world_from_base.Inverse() *
                                            fit.predicted[i] *
                                            fit.mounts.platform_from_tool.Inverse();
      cleaned.items[i].world_from_tool = fit.seen[i];
    }
    return cleaned;
  }

  GrownProblem::Data DataOf(const std::vector<Matrix6d>& whiteners) const {
    GrownProblem::Data data;
    data.dataset = &dataset_;
    data.hexapod = hexapod_;
    data.visits = &visits_;
    data.pose_map = model_.pose_map;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      data.poses.push_back({rows_[i],
                            observations_.items[i].world_from_tool,
                            whiteners.empty() ? Matrix6d(Matrix6d::Identity()) : whiteners[i]});
    return data;
  }

  std::vector<GrownEffect> Held() const {
    std::vector<GrownEffect> held;
    for (const Effect& effect : fit_.effects) held.push_back({effect, {}, {}, {}});
    return held;
  }

  GrownProblem Problem(const Estimate& before) const {
    std::vector<Matrix6d> whiteners;
    const NoiseLevels levels = LevelsOf(observations_, options_.noise, before);
    for (const Observation& o : observations_.items)
      whiteners.push_back(
          WhitenerOf(ErrorCovariance(o, observations_, before.mounts.platform_from_tool, levels)));
    GrownProblem::Data data = DataOf(whiteners);
    data.with_misfit =
        std::any_of(fit_.effects.begin(), fit_.effects.end(), IsOfTrackerOrMarkers) &&
        dataset_.measurement->kind == Measurement::Kind::kMarkers;
    if (data.with_misfit && !dataset_.measurement->marker_sigma) data.misfit_scale = MisfitScale();
    std::vector<GrownEffect> effects;
    for (const Effect& effect : fit_.effects) effects.push_back(FreeEffect(effect, kPriorWidths));
    return GrownProblem(std::move(data), std::move(effects));
  }

  // The sigma of a reading that is not stated, m, by what rigid fits leave.
  double MisfitScale() const {
    GrownProblem::Data data = DataOf({});
    data.with_misfit = true;
    const GrownProblem problem(std::move(data), Held());
    const auto evaluation = problem.Evaluate(fit_.mounts, Eigen::VectorXd(), false);
    if (!evaluation || problem.misfit_freedom() <= 0) return 1.0;
    const double squared = evaluation->residual.tail(problem.num_misfit()).squaredNorm();
    return squared > 0.0 ? std::sqrt(squared / problem.misfit_freedom()) : 1.0;
  }

  void Finish(Estimate* estimate) const {
    estimate->mounts = MountsOfFit();
    if (!fit_.converged) {
      estimate->converged = false;
      estimate->message = fit_.message;
      estimate->warnings.push_back("no convergence with the effects: " + fit_.message);
    }
    if (fit_.covariance.rows() < 12) return;
    estimate->degrees_of_freedom =
        std::max(1, estimate->degrees_of_freedom - static_cast<int>(fit_.free.size()));
    estimate->noise_scale = std::sqrt(estimate->chi_square / estimate->degrees_of_freedom);
    const bool is_scaled = estimate->noise.estimated;
    const Matrix12d joint = fit_.covariance.topLeftCorner<12, 12>(), common = CommonCovariance();
    estimate->covariance_unscaled = joint + common;
    estimate->covariance = (is_scaled ? std::pow(estimate->noise_scale, 2) : 1.0) * joint + common;
    estimate->intervals =
        is_scaled ? IntervalsOfScaledNoise(estimate->covariance, estimate->degrees_of_freedom)
                  : IntervalsOfKnownNoise(estimate->covariance);
    for (std::size_t k = 12; k < fit_.determined.size(); ++k)
      if (!fit_.determined[k]) AddDoubt(k - 12, estimate);
  }

  // The error of a tracker that stood still is not in the poses: it moves the base alone.
  Matrix12d CommonCovariance() const {
    Matrix12d common = Matrix12d::Zero();
    if (observations_.tracker_from_world) {
      const Matrix6d carry = InverseAdjoint(fit_.mounts.world_from_base);
      common.topLeftCorner<6, 6>() =
          carry * observations_.tracker_from_world_covariance * carry.transpose();
    }
    return common;
  }

  void AddDoubt(std::size_t number, Estimate* estimate) const {
    std::size_t at = 0;
    for (const Effect& effect : fit_.effects) {
      const GrownEffect grown = FreeEffect(effect, kPriorWidths);
      if (number < at + grown.free.size()) {
        const int n = grown.free[number - at];
        estimate->warnings.push_back(
            fmt::format("the data do not determine number {} of the effect '{}' ({})",
                        n + 1,
                        effect.name,
                        FindEffectKind(effect.name)->ParameterOf(n).name));
        return;
      }
      at += grown.free.size();
    }
  }

  Machine Grown() const {
    Machine machine = model_;
    machine.dataset = dataset_.name;
    machine.world_from_base = fit_.mounts.world_from_base;
    machine.platform_from_tool = fit_.mounts.platform_from_tool;
    machine.world_from_tracker.reset();
    if (observations_.tracker_from_world)
      machine.world_from_tracker = observations_.tracker_from_world->Inverse();
    if (hexapod_ != nullptr) machine.hexapod = *hexapod_;
    if (machine.hexapod && !machine.hexapod->home) machine.hexapod->home = home_;
    machine.effects = fit_.effects;
    return machine;
  }

  const Dataset& dataset_;
  const Machine& model_;
  const HexapodGeometry* hexapod_;
  Observations observations_;
  CalibrateOptions options_;
  std::vector<Visit> visits_;
  std::vector<int> rows_;  // of the observations
  Pose3d home_;
  GrownFit fit_;
};

}  // namespace

GrownCalibration CalibrateGrown(const Dataset& dataset,
                                const Machine& model,
                                const CalibrateOptions& options) {
  const bool has_swap = std::any_of(model.effects.begin(), model.effects.end(), [](const auto& e) {
    return e.name == "swapped_markers";
  });
  if (!has_swap) return Grower(dataset, model, options).Run();
  Dataset mended = dataset;
  mended.measurement = MendedMeasurement(*dataset.measurement, model.effects);
  return Grower(mended, model, options).Run();
}

}  // namespace hexcal
