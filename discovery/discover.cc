// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/discover.h"

#include <algorithm>
#include <utility>

#include "discovery/findings.h"
#include "discovery/given.h"
#include "discovery/investigation.h"
#include "discovery/prepare.h"
#include "estimator/calibrate.h"
#include "model/described_effect.h"
#include "model/predict.h"

namespace hexcal {
namespace {

// Priors on given effects: of their own size, as calibrate --model has them.
constexpr double kGivenWidth = 3.0;

class Discoverer {
 public:
  Discoverer(const MendedDataset& mended, const DiscoverOptions& options)
      : work_{mended.dataset, options, MakeObservations(mended.dataset)} {
    work_.faults = mended.swaps;
  }

  Discovery Run() {
    Prepared start = Prepare(&work_);
    result_.base_and_tool = std::move(start.base_and_tool);
    start_ = start.mounts;
    given_now_ = std::move(start.given_now);
    for (const auto& [name, needs] : work_.library.not_testable)
      result_.not_testable.push_back({name, needs});
    work_.selection = SelectEffects(work_, work_.options.most_effects);
    TestOnHeldOut();
    CompareWithGeometry();
    Grow();
    FillFindings(work_, &result_);
    return std::move(result_);
  }

 private:
  static Mounts MountsOf(const Estimate& estimate) {
    return {estimate.mounts.world_from_base, estimate.mounts.platform_from_tool};
  }

  void Report(const char* stage, int done, int of) const {
    if (work_.options.progress) work_.options.progress(stage, done, of);
  }

  void TestOnHeldOut() {
    if (work_.options.folds < 2) {
      work_.held.after_steps.assign(work_.selection.chosen.size() + 1, 0.0);
      return;
    }
    work_.held = HoldOut(work_.problem.linear,
                         work_.problem.trend,
                         work_.selection,
                         work_.options.folds,
                         work_.options.seed,
                         [this](int done) { Report("held-out poses", done, work_.options.folds); });
  }

  // A map of the pose has to foretell poses better than legs that nobody published.
  void CompareWithGeometry() {
    if (work_.selection.chosen.empty() || work_.data.hexapod || !work_.given.empty()) return;
    Report("leg geometry", 0, 1);
    work_.geometry = FindUnknownGeometry(work_.data,
                                         MountsOf(result_.base_and_tool),
                                         work_.problem,
                                         work_.library,
                                         work_.selection,
                                         work_.options.folds,
                                         work_.options.seed);
    if (!work_.geometry) return;
    GeometryClass& report = work_.geometry->report;
    report.heldout_map = work_.held.after;
    report.is_in_model = work_.options.folds >= 2 && Wins(report);
    if (report.is_in_model) {
      work_.selection.noise = work_.geometry->noise;
      work_.held.before = work_.geometry->heldout_before,
      work_.held.after = work_.geometry->heldout_after;
      // What is in the model was tested.
      auto& absent = result_.not_testable;
      absent.erase(
          std::remove_if(absent.begin(),
                         absent.end(),
                         [](const NotTestable& effect) { return IsGeometryError(effect.name); }),
          absent.end());
    }
    result_.leg_geometry = report;
  }

  // The exact machine, from where the linear fit says.
  void Grow() {
    Report("refit", 0, 1);
    if (work_.HasGeometry())
      work_.refit = RefitGeometry(*work_.geometry, &work_.data);
    else
      GrowForms();
    if (!work_.refit.converged)
      result_.warnings.emplace_back("the refit with the effects did not converge");
    FillMachine();
    FillEstimate();
    result_.observations = work_.observations;
    result_.refit = work_.refit.iterations;
  }

  void GrowForms() {
    // What the data determine badly is held to the size that they make likely.
    double width =
        work_.selection.chosen.empty()
            ? kWidePrior
            : Scorer(work_.problem.linear.Only(work_.selection.chosen), work_.selection.noise)
                  .LikeliestWidth(0);
    width = std::max(width, kGivenWidth * LargestSize(given_now_));
    const JointFit fit = FitJointly(work_.problem.linear,
                                    work_.selection.noise,
                                    work_.selection.chosen,
                                    width,
                                    Eigen::VectorXd());
    std::vector<Effect> effects = given_now_;
    Eigen::Index at = 0;
    for (const int form : work_.selection.chosen) {
      const FormDefinition& definition = work_.library.forms[form];
      effects.push_back(EffectOf(definition, fit.coefficients.segment(at, definition.size())));
      at += definition.size();
    }
    Mounts start = start_;
    // Given effects may trade with the mounts: both stay where they are.
    if (given_now_.empty()) {
      start.world_from_base = Plus(start.world_from_base, Vector6d(fit.mounts.head<6>()));
      start.platform_from_tool = Plus(start.platform_from_tool, Vector6d(fit.mounts.segment<6>(6)));
    }
    // Where nothing was found base and tool stay as they were.
    if (effects.empty())
      work_.refit = Unchanged();
    else
      work_.refit = RefitMachine(work_.data, start, effects, work_.selection.noise, width);
  }

  Refit Unchanged() const {
    Refit same;
    same.mounts = MountsOf(result_.base_and_tool);
    same.problem = MakeGapProblem(work_.data, same.mounts, {}, {});
    same.covariance =
        FitJointly(same.problem.linear, work_.selection.noise, {}, kWidePrior, Eigen::VectorXd())
            .covariance;
    same.converged = true;
    return same;
  }

  void FillMachine() {
    Machine& machine = result_.machine;
    machine.dataset = work_.dataset.name;
    machine.world_from_base = work_.refit.mounts.world_from_base;
    machine.platform_from_tool = work_.refit.mounts.platform_from_tool;
    machine.hexapod = work_.data.hexapod;
    // Where the first move came from must not depend on the rows that are predicted.
    if (machine.hexapod && !machine.hexapod->home)
      machine.hexapod->home = HomePose(&*machine.hexapod, work_.reported);
    if (work_.observations.tracker_from_world)
      machine.world_from_tracker = work_.observations.tracker_from_world->Inverse();
    machine.effects = work_.given_faults;
    for (const FaultFound& fault : work_.faults) machine.effects.push_back(fault.effect);
    for (const Effect& effect : work_.refit.effects) {
      if (IsPoseMap(effect))
        machine.pose_map = PoseMapOf(effect);
      else
        machine.effects.push_back(effect);
    }
  }

  // As a calibration of poses from which the effects are taken out; the covariance is the joint
  // fit's, which knows that the effects are uncertain too.
  void FillEstimate() {
    Observations cleaned = work_.observations;
    for (std::size_t k = 0; k < cleaned.items.size(); ++k) {
      cleaned.items[k].base_from_platform = work_.refit.mounts.world_from_base.Inverse() *
                                            work_.refit.problem.predicted[k] *
                                            work_.refit.mounts.platform_from_tool.Inverse();
      cleaned.items[k].world_from_tool = work_.refit.problem.seen[k].world_from_tool;
    }
    CalibrateOptions options;
    options.noise = work_.options.noise;
    result_.estimate = Calibrate(cleaned, std::nullopt, options);
    if (work_.refit.effects.empty()) return;
    result_.estimate.mounts = {work_.refit.mounts.world_from_base,
                               work_.refit.mounts.platform_from_tool};
    result_.estimate.covariance = work_.refit.covariance.topLeftCorner<12, 12>();
    // The base inherits the error of the frame that a tracker that stood still made of it.
    const Matrix6d carry = InverseAdjoint(work_.refit.mounts.world_from_base);
    result_.estimate.covariance.topLeftCorner<6, 6>() +=
        carry * work_.observations.tracker_from_world_covariance * carry.transpose();
    const auto more = static_cast<int>(work_.refit.covariance.rows()) - 12;
    Estimate& estimate = result_.estimate;
    estimate.intervals =
        estimate.noise.estimated
            ? IntervalsOfScaledNoise(estimate.covariance,
                                     std::max(1, estimate.degrees_of_freedom - more))
            : IntervalsOfKnownNoise(estimate.covariance);
  }

  Investigation work_;
  Discovery result_;
  Mounts start_;                   // where the linear problem is
  std::vector<Effect> given_now_;  // and the effects of a model
};

}  // namespace

Discovery Discover(const Dataset& dataset, const DiscoverOptions& options) {
  const MendedDataset mended = MendMarkers(dataset, options);
  return Discoverer(mended, options).Run();
}

}  // namespace hexcal
