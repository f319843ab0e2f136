// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "discovery/exchange.h"
#include "discovery/experiments.h"
#include "discovery/joint_fit.h"
#include "discovery/plan_judge.h"
#include "discovery/planned_visits.h"
#include "discovery/pose_pool.h"
#include "discovery/rival_models.h"

namespace hexcal {
namespace {

constexpr int kSettings = 3;           // of the covariates a pose, where they may tell rivals apart
constexpr std::size_t kMostPairs = 8;  // that poses are chosen for; all are judged
constexpr int kOrders = 12;            // random ones, of which the best is taken
constexpr double kRivalsShare = 0.02;  // of the parameters' log determinant beside rivals
constexpr double kSpan = 1e-9;         // m, rad: less is rounding
constexpr int kSteps = 10;             // of the mounts
constexpr double kArrived = 1e-2;      // of a standard deviation

// The noise that a dataset states, or that was given, taken for right.
GapNoise StatedNoise(const LinearProblem& problem, const std::optional<NoiseLevels>& levels) {
  GapNoise noise;
  noise.factor.assign(problem.components.size(), 0.0);
  noise.factor[0] = 1.0;
  if (levels && noise.factor.size() == 2)
    noise.factor = {levels->position * levels->position, levels->orientation * levels->orientation};
  return noise;
}

bool IsStated(const Dataset& dataset) {
  const Measurement& measurement = *dataset.measurement;
  return measurement.kind == Measurement::Kind::kMarkers ? measurement.marker_sigma.has_value()
                                                         : measurement.pose_noise.has_value();
}

PlannedVisits Picked(const PlannedVisits& visits, const std::vector<int>& which) {
  PlannedVisits some;
  for (const int k : which) {
    some.base_from_platform.push_back(visits.base_from_platform[k]);
    some.covariates.push_back(visits.covariates[k]);
  }
  return some;
}

class Planner {
 public:
  Planner(const Dataset& dataset, const Machine& machine, const PlanOptions& options)
      : options_(options), scene_(MakePlanScene(dataset, machine)) {
    mounts_ = {machine.world_from_base, machine.platform_from_tool};
  }

  Plan Run() {
    RequireNoise();
    forms_ = OwnForms(scene_.effects);
    if (scene_.measured > 0) LearnFromMeasured();
    plan_.goal =
        options_.goal.value_or(forms_.rivals.empty() ? PlanGoal::kParameters : PlanGoal::kRivals);
    Choose();
    Order();
    Judge();
    return std::move(plan_);
  }

 private:
  void Report(const char* stage, int done, int of) const {
    if (options_.progress) options_.progress(stage, done, of);
  }

  void RequireNoise() const {
    if (scene_.measured > 0 || IsStated(scene_.dataset) || options_.noise) return;
    throw InputError(scene_.dataset.measurement->where,
                     "no measured poses and no noise",
                     "noise: in the measurement, to know what a pose is worth");
  }

  // Mounts of these data, their noise, and what the effects could also be.
  void LearnFromMeasured() {
    Report("measured poses", 0, 1);
    const GapData data = MakeGapData(scene_.dataset, scene_.reported);
    GapProblem problem;
    std::vector<int> free(scene_.effects.size());
    std::iota(free.begin(), free.end(), static_cast<int>(free.size()));
    for (int step = 0; step < kSteps; ++step) {
      problem = MakeGapProblem(data, mounts_, scene_.effects, forms_.library);
      const LinearProblem with = problem.linear.With(free);
      noise_ = IsStated(scene_.dataset) || options_.noise
                   ? Filled(StatedNoise(problem.linear, options_.noise), problem.linear)
                   : EstimateGapNoise(with, problem.trend);
      const JointFit fit = FitJointly(with, noise_, {}, 1.0, Eigen::VectorXd());
      const Eigen::VectorXd size =
          fit.mounts.cwiseAbs().cwiseQuotient(fit.covariance.diagonal().cwiseSqrt());
      if (!(size.head<12>().maxCoeff() > kArrived)) break;
      mounts_.world_from_base = Plus(mounts_.world_from_base, Vector6d(fit.mounts.head<6>()));
      mounts_.platform_from_tool =
          Plus(mounts_.platform_from_tool, Vector6d(fit.mounts.segment<6>(6)));
    }
    if (options_.goal == PlanGoal::kParameters || scene_.effects.empty()) return;
    Report("rivals", 0, 1);
    // Rivals are judged as discovery judges them, by the noise that the data show.
    const LinearProblem with = problem.linear.With(free);
    const GapNoise as_stated = noise_;
    noise_ = EstimateGapNoise(with, problem.trend);
    forms_ = WithRivals(scene_, data, mounts_, noise_);
    if (forms_.rivals.empty()) noise_ = as_stated;
    WarnOfDescriptions();
  }

  // No poses can be chosen by what has no law.
  void WarnOfDescriptions() {
    for (std::size_t e = 0; e < scene_.effects.size(); ++e) {
      const Effect& effect = scene_.effects[e];
      const bool has_rival =
          std::any_of(forms_.rivals.begin(), forms_.rivals.end(), [e](const RivalModel& rival) {
            return rival.effect == static_cast<int>(e);
          });
      if (effect.name != kUnknownEffect || has_rival || effect.found.count("driver") == 0) continue;
      plan_.warnings.push_back(
          fmt::format("{} that follows {} at the {} is a description without a law: no pose is "
                      "planned to name it; of leg geometry: {}",
                      effect.name,
                      effect.found.at("driver"),
                      effect.found.at("site"),
                      ExperimentFor("leg_offset", "base_joint_offset")));
    }
  }

  static GapNoise Filled(GapNoise noise, const LinearProblem& problem) {
    noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(problem.poses);
    return noise;
  }

  struct Design {
    GapProblem problem;
    DesignRows rows;
    DesignModels models;
    std::vector<int> known, new_ones;  // poses of the rows
  };

  Design DesignOf(const PlannedVisits& visits, bool is_pool) const {
    const Dataset all = WithVisits(scene_, visits);
    const GapData data = GapDataOf(scene_, visits, all, is_pool, options_.poses);
    Design design;
    design.problem = MakeGapProblem(data, mounts_, scene_.effects, forms_.library);
    const LinearProblem& linear = design.problem.linear;
    const GapNoise noise =
        scene_.measured > 0 ? noise_ : Filled(StatedNoise(linear, options_.noise), linear);
    design.rows = MakeDesignRows(linear, noise);
    design.models = MakeDesignModels(forms_, scene_.effects, linear, design.rows);
    for (int pose = 0; pose < linear.poses; ++pose)
      (pose < scene_.measured ? design.known : design.new_ones).push_back(pose);
    return design;
  }

  DesignGoal GoalOf(const Design& design) const {
    DesignGoal goal;
    goal.parameters = design.models.parameters;
    if (plan_.goal == PlanGoal::kParameters) return goal;
    for (const std::size_t pair : sought_) goal.pairs.push_back(design.models.pairs[pair]);
    if (!goal.pairs.empty()) goal.parameter_weight = kRivalsShare;
    return goal;
  }

  // The pairs that the measured poses tell apart least.
  void Seek(const Design& design) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t p = 0; p < design.models.pairs.size(); ++p)
      if (!design.models.pairs[p].empty())
        order.emplace_back(DistanceOf(design.models.pairs[p], design.rows, design.known), p);
    std::sort(order.begin(), order.end());
    if (order.size() > kMostPairs) order.resize(kMostPairs);
    for (const auto& [distance, pair] : order) sought_.push_back(pair);
  }

  void Choose() {
    const HexapodGeometry* hexapod = scene_.dataset.hexapod ? &*scene_.dataset.hexapod : nullptr;
    const Reach reach = ReachOf(hexapod, scene_.reported);
    RequireReach(reach);
    pool_ = MakeVisitPool(scene_,
                          MakePosePool(reach, options_.pool, options_.seed),
                          options_.poses,
                          plan_.goal == PlanGoal::kRivals ? kSettings : 1,
                          options_.settings,
                          options_.seed);
    plan_.measured = scene_.measured;
    plan_.pool = static_cast<int>(pool_.base_from_platform.size());
    pool_design_ = DesignOf(pool_, true);
    Seek(pool_design_);
    const std::vector<int> chosen =
        ChoosePoses(GoalOf(pool_design_),
                    pool_design_.rows,
                    pool_design_.known,
                    pool_design_.new_ones,
                    options_.poses,
                    [this](int done, int of) { Report("poses", done, of); });
    for (const int pose : chosen) chosen_.push_back(pose - scene_.measured);
  }

  void RequireReach(const Reach& reach) const {
    if ((reach.high - reach.low).maxCoeff() > kSpan) return;
    throw InputError(scene_.dataset.robot_poses.where,
                     "poses that are all alike",
                     "poses that span where the platform can go, or leg_limits of the hexapod");
  }

  // The best of some random orders: only what follows time or the last move asks for one.
  void Order() {
    std::mt19937_64 generator(options_.seed);
    double best = -std::numeric_limits<double>::infinity();
    for (int order = 0; order < kOrders; ++order) {
      Report("order", order, kOrders);
      for (std::size_t k = chosen_.size(); k > 1; --k)
        std::swap(chosen_[k - 1], chosen_[generator() % k]);
      const PlannedVisits visits = InTime(scene_, Picked(pool_, chosen_));
      Design design = DesignOf(visits, false);
      std::vector<int> all = design.known;
      all.insert(all.end(), design.new_ones.begin(), design.new_ones.end());
      const double utility = UtilityOf(GoalOf(design), design.rows, all);
      if (utility > best) best = utility, planned_ = visits, design_ = std::move(design);
    }
  }

  void Judge() {
    plan_.poses = RobotPosesOf(scene_, planned_);
    plan_.base_from_platform = planned_.base_from_platform;
    std::vector<int> all = design_.known;
    all.insert(all.end(), design_.new_ones.begin(), design_.new_ones.end());
    plan_.deviation_before = Deviations(design_.models.parameters, design_.rows, design_.known);
    plan_.deviation_after = Deviations(design_.models.parameters, design_.rows, all);
    for (std::size_t r = 0; r < forms_.rivals.size(); ++r) {
      const RivalModel& rival = forms_.rivals[r];
      const Effect& effect = scene_.effects[rival.effect];
      RivalPair pair;
      pair.effect = effect.name, pair.index = effect.index, pair.rival = rival.name;
      MeasureDistances(design_.rows,
                       design_.models.effects[rival.effect],
                       design_.models.pairs[r],
                       design_.known,
                       all,
                       &pair);
      MeasureWholePool(pool_design_.rows,
                       pool_design_.models.effects[rival.effect],
                       pool_design_.models.pairs[r],
                       &pair);
      Classify(options_.poses, &pair);
      pair.experiment = ExperimentFor(effect.name, rival.name);
      plan_.pairs.push_back(std::move(pair));
    }
    const bool for_rivals = plan_.goal == PlanGoal::kRivals;
    plan_.reasons = Reasons(design_.models.parameters,
                            for_rivals ? design_.models.pairs : decltype(design_.models.pairs)(),
                            design_.rows,
                            design_.known,
                            design_.new_ones);
  }

  const PlanOptions& options_;
  PlanScene scene_;
  Mounts mounts_;
  GapNoise noise_;
  PlanForms forms_;
  PlannedVisits pool_, planned_;
  Design pool_design_, design_;
  std::vector<std::size_t> sought_;  // rivals that the poses are chosen for
  std::vector<int> chosen_;          // of the pool
  Plan plan_;
};

}  // namespace

Plan MakePlan(const Dataset& dataset, const Machine& machine, const PlanOptions& options) {
  return Planner(dataset, machine, options).Run();
}

}  // namespace hexcal
