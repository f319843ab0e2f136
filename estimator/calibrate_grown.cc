// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate_grown.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "estimator/free_effect.h"
#include "estimator/grown_solution.h"
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
  Grower(std::shared_ptr<const Dataset> dataset,
         const Machine& model,
         const CalibrateOptions& options)
      : dataset_(*dataset), model_(model), work_(std::make_shared<GrownSolution>()) {
    options_.noise = options.noise;
    options_.threads = options.threads;
    options_.start = Start::kInitial;
    GrownSolution& work = *work_;
    work.dataset = std::move(dataset);
    if (const HexapodGeometry* hexapod = HexapodOf(dataset_, model)) work.hexapod = *hexapod;
    const std::vector<Pose3d> reported = ReportedPoses(dataset_, model);
    MachineRows machine_rows(dataset_, model, reported, EffectSites::kAll);
    for (std::size_t i = 0; i < reported.size(); ++i)
      work.visits.push_back(machine_rows.Next().visit);
    for (const ToolPose& pose : ComputeToolPoses(dataset_).poses) work.rows.push_back(pose.pose);
    work.observations = MakeObservations(dataset_);
    CHECK_EQ(work.rows.size(), work.observations.items.size());
    for (std::size_t i = 0; i < work.rows.size(); ++i)
      work.observations.items[i].base_from_platform = reported[work.rows[i]];
    work.home = HomePose(work.hexapod ? &*work.hexapod : nullptr, reported);
  }

  GrownCalibration Run() {
    GrownFit& fit = work_->fit;
    fit.mounts = {model_.world_from_base, model_.platform_from_tool};
    fit.effects = model_.effects;
    GrownCalibration result;
    // The first look is through the model as it is, with base and tool wherever they are now.
    Look();
    result.estimate = Calibrate(work_->cleaned, std::nullopt, Plain());
    const BaseAndTool& now = result.estimate.mounts;
    fit.mounts = {now.world_from_base, now.platform_from_tool};
    const bool is_stated = work_->observations.tool_noise_is_known || options_.noise.has_value();
    for (int round = 0; round < (is_stated ? 1 : kRounds); ++round) {
      Prepare(result.estimate);
      fit = FitGrown(work_->Problem(), fit.mounts, {}, {});
      Clean();
      result.estimate = Calibrate(work_->cleaned, MountsOfFit(), options_);
    }
    Finish(&result.estimate);
    result.machine = Grown();
    result.solution = work_;
    return result;
  }

 private:
  CalibrateOptions Plain() const {
    CalibrateOptions plain = options_;
    plain.start = Start::kClosedForm;
    return plain;
  }

  BaseAndTool MountsOfFit() const {
    const Mounts& mounts = work_->fit.mounts;
    return {mounts.world_from_base, mounts.platform_from_tool};
  }

  // What the model as it is predicts and sees.
  void Look() {
    GrownFit& fit = work_->fit;
    const GrownProblem problem(DataOf({}), Held());
    const auto evaluation = problem.Evaluate(fit.mounts, Eigen::VectorXd(), false);
    if (!evaluation)
      throw InputError(dataset_.robot_poses.where,
                       "poses that the model's effects put out of the legs' reach",
                       "poses inside the workspace of the model's hexapod");
    fit.predicted = evaluation->predicted;
    fit.seen = evaluation->seen;
    Clean();
  }

  // Poses without the effects: the platform where it must be for the mounts alone to predict as
  // much.
  void Clean() {
    const GrownFit& fit = work_->fit;
    work_->cleaned = work_->observations;
    for (std::size_t i = 0; i < work_->rows.size() && i < fit.predicted.size(); ++i) {
      Observation& item = work_->cleaned.items[i];
      item.base_from_platform = fit.mounts.world_from_base.Inverse() * fit.predicted[i] *
                                fit.mounts.platform_from_tool.Inverse();
      item.world_from_tool = fit.seen[i];
    }
  }

  GrownProblem::Data DataOf(const std::vector<Matrix6d>& whiteners) const {
    GrownProblem::Data data;
    data.dataset = &dataset_;
    data.hexapod = work_->hexapod ? &*work_->hexapod : nullptr;
    data.visits = &work_->visits;
    data.pose_map = model_.pose_map;
    for (std::size_t i = 0; i < work_->rows.size(); ++i)
      data.poses.push_back({work_->rows[i],
                            work_->observations.items[i].world_from_tool,
                            whiteners.empty() ? Matrix6d(Matrix6d::Identity()) : whiteners[i]});
    return data;
  }

  std::vector<GrownEffect> Held() const {
    std::vector<GrownEffect> held;
    for (const Effect& effect : work_->fit.effects) held.push_back({effect, {}, {}, {}});
    return held;
  }

  // The problem of the next fit.
  void Prepare(const Estimate& before) {
    const Observations& observations = work_->observations;
    const std::vector<Effect>& effects = work_->fit.effects;
    std::vector<Matrix6d> whiteners;
    const NoiseLevels levels = LevelsOf(observations, options_.noise, before);
    for (const Observation& o : observations.items)
      whiteners.push_back(
          WhitenerOf(ErrorCovariance(o, observations, before.mounts.platform_from_tool, levels)));
    work_->data = DataOf(whiteners);
    work_->data.with_misfit = std::any_of(effects.begin(), effects.end(), IsOfTrackerOrMarkers) &&
                              dataset_.measurement->kind == Measurement::Kind::kMarkers;
    if (work_->data.with_misfit && !dataset_.measurement->marker_sigma)
      work_->data.misfit_scale = MisfitScale();
    work_->effects.clear();
    for (const Effect& effect : effects) work_->effects.push_back(FreeEffect(effect, kPriorWidths));
  }

  // The sigma of a reading that is not stated, m, by what rigid fits leave.
  double MisfitScale() const {
    GrownProblem::Data data = DataOf({});
    data.with_misfit = true;
    const GrownProblem problem(std::move(data), Held());
    const auto evaluation = problem.Evaluate(work_->fit.mounts, Eigen::VectorXd(), false);
    if (!evaluation || problem.misfit_freedom() <= 0) return 1.0;
    const double squared = evaluation->residual.tail(problem.num_misfit()).squaredNorm();
    return squared > 0.0 ? std::sqrt(squared / problem.misfit_freedom()) : 1.0;
  }

  void Finish(Estimate* estimate) {
    const GrownFit& fit = work_->fit;
    estimate->mounts = MountsOfFit();
    if (!fit.converged) {
      estimate->converged = false;
      estimate->message = fit.message;
      estimate->warnings.push_back("no convergence with the effects: " + fit.message);
    }
    if (fit.covariance.rows() < 12) return;
    estimate->degrees_of_freedom =
        std::max(1, estimate->degrees_of_freedom - static_cast<int>(fit.free.size()));
    estimate->noise_scale = std::sqrt(estimate->chi_square / estimate->degrees_of_freedom);
    const bool is_scaled = estimate->noise.estimated;
    work_->is_noise_estimated = is_scaled;
    if (is_scaled) work_->noise_scale = estimate->noise_scale;
    SetCommon();
    estimate->covariance_unscaled = work_->CovarianceUnscaled().topLeftCorner<12, 12>();
    estimate->covariance = work_->Covariance().topLeftCorner<12, 12>();
    estimate->intervals =
        is_scaled ? IntervalsOfScaledNoise(estimate->covariance, estimate->degrees_of_freedom)
                  : IntervalsOfKnownNoise(estimate->covariance);
    for (const std::string& lost : work_->NotDetermined())
      estimate->warnings.push_back("the data do not determine " + lost);
  }

  // The error of a tracker that stood still is not in the poses: it moves the base alone.
  void SetCommon() {
    const Observations& observations = work_->observations;
    if (!observations.tracker_from_world) return;
    const Matrix6d carry = InverseAdjoint(work_->fit.mounts.world_from_base);
    work_->common = carry * observations.tracker_from_world_covariance * carry.transpose();
  }

  Machine Grown() const {
    Machine machine = model_;
    machine.dataset = dataset_.name;
    machine.world_from_base = work_->fit.mounts.world_from_base;
    machine.platform_from_tool = work_->fit.mounts.platform_from_tool;
    machine.world_from_tracker.reset();
    if (work_->observations.tracker_from_world)
      machine.world_from_tracker = work_->observations.tracker_from_world->Inverse();
    if (work_->hexapod) machine.hexapod = *work_->hexapod;
    if (machine.hexapod && !machine.hexapod->home) machine.hexapod->home = work_->home;
    machine.effects = work_->fit.effects;
    return machine;
  }

  const Dataset& dataset_;
  const Machine& model_;
  std::shared_ptr<GrownSolution> work_;
  CalibrateOptions options_;
};

}  // namespace

GrownCalibration CalibrateGrown(const Dataset& dataset,
                                const Machine& model,
                                const CalibrateOptions& options) {
  const bool has_swap = std::any_of(model.effects.begin(), model.effects.end(), [](const auto& e) {
    return e.name == "swapped_markers";
  });
  // Without a swap it is the caller's, which nobody owns here.
  if (!has_swap)
    return Grower(std::shared_ptr<const Dataset>(std::shared_ptr<void>(), &dataset), model, options)
        .Run();
  auto mended = std::make_shared<Dataset>(dataset);
  mended->measurement = MendedMeasurement(*dataset.measurement, model.effects);
  return Grower(std::move(mended), model, options).Run();
}

}  // namespace hexcal
