// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/discover.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/answers.h"
#include "discovery/faults.h"
#include "discovery/gap_model.h"
#include "discovery/geometry_words.h"
#include "discovery/hold_out.h"
#include "discovery/refit.h"
#include "discovery/rivals.h"
#include "discovery/select.h"
#include "discovery/swapped_markers.h"
#include "discovery/unknown_geometry.h"
#include "discovery/where.h"
#include "estimator/calibrate.h"
#include "estimator/quantiles.h"
#include "model/data_fault.h"
#include "model/described_effect.h"
#include "model/predict.h"

namespace hexcal {
namespace {

constexpr double kPrior = 30.0;  // of the linear fit, in plausible sizes: it holds gauges only
constexpr std::size_t kMostCandidates = 12;
constexpr double kGapIsThere = 1e-6;  // p of the residuals under the stated noise
constexpr double kMuchMore = 1.5;     // of the stated noise

class Discoverer {
 public:
  // swaps: what is already mended in the dataset.
  Discoverer(const Dataset& dataset,
             const std::vector<FaultFound>& swaps,
             const DiscoverOptions& options)
      : dataset_(dataset),
        options_(options),
        observations_(MakeObservations(dataset)),
        faults_(swaps) {}

  Discovery Run() {
    MendFaults();
    Calibrate12();
    data_ = MakeGapData(dataset_, reported_);
    library_ = MakeFormLibrary(dataset_, data_.visits, data_.rows);
    for (const auto& [name, needs] : library_.not_testable)
      result_.not_testable.push_back({name, needs});
    problem_ = MakeGapProblem(data_, MountsOf(result_.base_and_tool), {}, library_);
    SelectEffects();
    CompareWithGeometry();
    Grow();
    Judge();
    return std::move(result_);
  }

 private:
  static Mounts MountsOf(const Estimate& estimate) {
    return {estimate.mounts.world_from_base, estimate.mounts.platform_from_tool};
  }

  void Report(const char* stage, int done, int of) const {
    if (options_.progress) options_.progress(stage, done, of);
  }

  void MendFaults() {
    Report("faults of the data", 0, 1);
    reported_ = ReportedPoses(dataset_);
    if (const std::optional<FaultFound> fault = FindFault(dataset_, observations_)) {
      Machine machine;
      machine.hexapod = dataset_.hexapod;
      machine.effects = {fault->effect};
      reported_ = ReportedPoses(dataset_, machine);
      faults_.push_back(*fault);
      robot_is_mended_ = true;
    }
  }

  void Calibrate12() {
    CalibrateOptions options;
    options.noise = options_.noise;
    options.threads = options_.threads;
    result_.base_and_tool = Calibrate(observations_, std::nullopt, options);
    if (!robot_is_mended_) return;
    const ToolPoses tools = ComputeToolPoses(dataset_);
    for (std::size_t i = 0; i < observations_.items.size(); ++i)
      observations_.items[i].base_from_platform = reported_[tools.poses[i].pose];
    result_.base_and_tool = Calibrate(observations_, std::nullopt, options);
  }

  void SelectEffects() {
    SelectOptions options;
    options.alpha = options_.alpha;
    options.bootstraps = options_.bootstraps;
    options.most_effects = options_.most_effects;
    options.seed = options_.seed;
    options.progress = [this](int step) { Report("search", step, options_.most_effects + 1); };
    selection_ = Select(problem_.linear, problem_.trend, options);
    if (options_.folds < 2) {
      held_.after_steps.assign(selection_.chosen.size() + 1, 0.0);
      return;
    }
    held_ = HoldOut(problem_.linear,
                    problem_.trend,
                    selection_,
                    options_.folds,
                    options_.seed,
                    [this](int done) { Report("held-out poses", done, options_.folds); });
  }

  // A map of the pose has to foretell poses better than legs that nobody published.
  void CompareWithGeometry() {
    if (selection_.chosen.empty() || data_.hexapod) return;
    Report("leg geometry", 0, 1);
    geometry_ = FindUnknownGeometry(data_,
                                    MountsOf(result_.base_and_tool),
                                    problem_,
                                    library_,
                                    selection_,
                                    options_.folds,
                                    options_.seed);
    if (!geometry_) return;
    GeometryClass& report = geometry_->report;
    report.heldout_map = held_.after;
    report.is_in_model = options_.folds >= 2 && Wins(report);
    if (report.is_in_model) {
      selection_.noise = geometry_->noise;
      held_.before = geometry_->heldout_before, held_.after = geometry_->heldout_after;
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

  bool HasGeometry() const { return geometry_ && geometry_->report.is_in_model; }

  // The exact machine, from where the linear fit says.
  void Grow() {
    Report("refit", 0, 1);
    if (HasGeometry())
      refit_ = RefitGeometry(*geometry_, &data_);
    else
      GrowForms();
    if (!refit_.converged)
      result_.warnings.emplace_back("the refit with the effects did not converge");
    FillMachine();
    FillEstimate();
  }

  void GrowForms() {
    // What the data determine badly is held to the size that they make likely.
    const double width =
        selection_.chosen.empty()
            ? kPrior
            : Scorer(problem_.linear.Only(selection_.chosen), selection_.noise).LikeliestWidth(0);
    const JointFit fit =
        FitJointly(problem_.linear, selection_.noise, selection_.chosen, width, Eigen::VectorXd());
    std::vector<Effect> effects;
    Eigen::Index at = 0;
    for (const int form : selection_.chosen) {
      const FormDefinition& definition = library_.forms[form];
      effects.push_back(EffectOf(definition, fit.coefficients.segment(at, definition.size())));
      at += definition.size();
    }
    Mounts start = MountsOf(result_.base_and_tool);
    start.world_from_base = Plus(start.world_from_base, Vector6d(fit.mounts.head<6>()));
    start.platform_from_tool = Plus(start.platform_from_tool, Vector6d(fit.mounts.segment<6>(6)));
    // Where nothing was found base and tool stay as they were.
    if (effects.empty())
      refit_ = Unchanged();
    else
      refit_ = RefitMachine(data_, start, effects, selection_.noise, width);
  }

  Refit Unchanged() const {
    Refit same;
    same.mounts = MountsOf(result_.base_and_tool);
    same.problem = MakeGapProblem(data_, same.mounts, {}, {});
    same.covariance =
        FitJointly(same.problem.linear, selection_.noise, {}, kPrior, Eigen::VectorXd()).covariance;
    same.converged = true;
    return same;
  }

  void FillMachine() {
    Machine& machine = result_.machine;
    machine.dataset = dataset_.name;
    machine.world_from_base = refit_.mounts.world_from_base;
    machine.platform_from_tool = refit_.mounts.platform_from_tool;
    machine.hexapod = data_.hexapod;
    // Where the first move came from must not depend on the rows that are predicted.
    if (machine.hexapod && !machine.hexapod->home)
      machine.hexapod->home = HomePose(&*machine.hexapod, reported_);
    if (observations_.tracker_from_world)
      machine.world_from_tracker = observations_.tracker_from_world->Inverse();
    for (const FaultFound& fault : faults_) machine.effects.push_back(fault.effect);
    for (const Effect& effect : refit_.effects) {
      if (IsPoseMap(effect))
        machine.pose_map = PoseMapOf(effect);
      else
        machine.effects.push_back(effect);
    }
  }

  // As a calibration of poses from which the effects are taken out; the covariance is the joint
  // fit's, which knows that the effects are uncertain too.
  void FillEstimate() {
    Observations cleaned = observations_;
    for (std::size_t k = 0; k < cleaned.items.size(); ++k) {
      cleaned.items[k].base_from_platform = refit_.mounts.world_from_base.Inverse() *
                                            refit_.problem.predicted[k] *
                                            refit_.mounts.platform_from_tool.Inverse();
      cleaned.items[k].world_from_tool = refit_.problem.seen[k].world_from_tool;
    }
    CalibrateOptions options;
    options.noise = options_.noise;
    result_.estimate = Calibrate(cleaned, std::nullopt, options);
    if (refit_.effects.empty()) return;
    result_.estimate.mounts = {refit_.mounts.world_from_base, refit_.mounts.platform_from_tool};
    result_.estimate.covariance = refit_.covariance.topLeftCorner<12, 12>();
    // The base inherits the error of the frame that a tracker that stood still made of it.
    const Matrix6d carry = InverseAdjoint(refit_.mounts.world_from_base);
    result_.estimate.covariance.topLeftCorner<6, 6>() +=
        carry * observations_.tracker_from_world_covariance * carry.transpose();
  }

  void Judge() {
    FillSteps();
    FillGap();
    AddGeometryStep();
    FillEffects();
    std::vector<std::string> labels;
    for (const int row : data_.rows) labels.push_back(dataset_.robot_poses.rows[row].label);
    result_.where = Localise(problem_.linear,
                             selection_.noise,
                             selection_.steps.front(),
                             labels,
                             SitesOf(library_),
                             DriversOf(library_));
    result_.detectable = DetectableSizes(
        problem_.linear, selection_.noise, selection_.chosen, options_.alpha, UnitsOf(library_));
    FillNoise();
    FillPoses();
    result_.verdict = VerdictOf();
  }

  void FillSteps() {
    std::vector<int> so_far;
    for (const SelectionStep& from : selection_.steps) {
      Step step;
      for (std::size_t k = 0; k < from.families.size() && k < kMostCandidates; ++k) {
        const auto& family = from.families[k];
        step.candidates.push_back({library_.families[family.family].name,
                                   problem_.linear.forms[family.best.form].index,
                                   family.evidence,
                                   std::pow(10.0, family.log10_p),
                                   family.log10_p});
      }
      if (from.added >= 0) {
        step.added = NameOfForm(from.added);
        so_far.push_back(from.added);
      }
      step.p_value = from.p_value;
      const JointFit fit =
          FitJointly(problem_.linear, selection_.noise, so_far, kPrior, Eigen::VectorXd());
      step.after = SizeOf(problem_.linear, selection_.noise, fit.left, ParametersOf(so_far));
      result_.steps.push_back(std::move(step));
    }
  }

  // What took the place of the map, after the steps that led to it.
  void AddGeometryStep() {
    if (!HasGeometry()) return;
    Step step;
    step.added = "base_joint_offset";
    step.p_value = result_.steps.front().p_value;
    step.after = result_.gap.after;
    result_.steps.push_back(std::move(step));
  }

  int ParametersOf(const std::vector<int>& forms) const {
    int count = 12;
    for (const int f : forms) count += problem_.linear.forms[f].size;
    return count;
  }

  std::string NameOfForm(int form) const {
    const Family& family = library_.families[problem_.linear.forms[form].family];
    return family.is_described ? std::string(kUnknownEffect) : family.name;
  }

  void FillGap() {
    const JointFit alone =
        FitJointly(problem_.linear, selection_.noise, {}, kPrior, Eigen::VectorXd());
    result_.gap.before = SizeOf(problem_.linear, selection_.noise, alone.left, 12);
    result_.gap.after = SizeOf(
        problem_.linear,
        selection_.noise,
        refit_.problem.linear.error,
        HasGeometry() ? 6 * problem_.linear.poses - geometry_->report.after.degrees_of_freedom
                      : ParametersOf(selection_.chosen));
    result_.gap.heldout_before = held_.before;
    result_.gap.heldout_after = held_.after;
    // Noise of the measurement and of all that was fitted, at each pose.
    double position = 0.0, orientation = 0.0;
    std::vector<int> all(refit_.problem.linear.forms.size());
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<int>(f);
    const Eigen::MatrixXd columns = refit_.problem.linear.With(all).nuisance;
    for (int k = 0; k < problem_.linear.poses; ++k) {
      const Eigen::MatrixXd by = columns.middleRows(6 * k, 6);
      const Matrix6d root = selection_.noise.Root(problem_.linear, k);
      const Matrix6d covariance = root * root.transpose() + by * refit_.covariance * by.transpose();
      position += covariance.topLeftCorner<3, 3>().trace();
      orientation += covariance.bottomRightCorner<3, 3>().trace();
    }
    GapSize& floor = result_.gap.noise_floor;
    floor.rms_position = std::sqrt(position / problem_.linear.poses);
    floor.rms_orientation = std::sqrt(orientation / problem_.linear.poses);
    floor.degrees_of_freedom = result_.gap.after.degrees_of_freedom;
    floor.chi_square = floor.degrees_of_freedom;
  }

  double ClosedBy(double after) const {
    const auto square = [](double x) { return x * x; };
    const double before = square(result_.gap.heldout_before.rms_position);
    const double floor = square(result_.gap.noise_floor.rms_position);
    return before > floor ? (before - square(after)) / (before - floor) : 0.0;
  }

  void FillEffects() {
    for (const FaultFound& fault : faults_) {
      DiscoveredEffect found = AnswerFor(fault.effect, dataset_);
      found.log10_p = -fault.gain / (2.0 * std::log(10.0));
      found.p_value = std::pow(10.0, found.log10_p);
      result_.effects.push_back(std::move(found));
    }
    const bool kind_poses = dataset_.measurement->kind == Measurement::Kind::kPoses;
    const std::vector<std::vector<Rival>> rivals =
        RivalsOf(problem_.linear, selection_.noise, selection_.chosen, kind_poses);
    std::size_t refitted = 0;
    bool is_class_there = false;
    for (std::size_t k = 0; k < selection_.chosen.size(); ++k) {
      const int form = selection_.chosen[k];
      const bool follows_pose = FollowsPose(library_.forms[form].effect);
      const bool is_class = follows_pose && HasGeometry();
      if (is_class && is_class_there) continue;
      if (HasGeometry() && !follows_pose && !geometry_->Keeps(form)) continue;
      DiscoveredEffect found =
          is_class ? GeometryAnswer() : AnswerFor(refit_.effects[refitted++], dataset_);
      found.p_value = selection_.p_values[k];
      found.log10_p = selection_.log10_p[k];
      found.gap_closed = ClosedBy(is_class ? held_.after.rms_position : held_.after_steps[k + 1]);
      if (!is_class) found.could_also_be = rivals[k];
      if (follows_pose && geometry_ && !is_class_there) {
        const std::vector<Rival> more = GeometryRivals(geometry_->report);
        found.could_also_be.insert(found.could_also_be.begin(), more.begin(), more.end());
        is_class_there = true;
      }
      result_.effects.push_back(std::move(found));
    }
  }

  // The class under the name of its most probable member.
  DiscoveredEffect GeometryAnswer() const {
    const auto member =
        std::find_if(refit_.effects.begin(), refit_.effects.end(), [](const Effect& effect) {
          return effect.name == "base_joint_offset";
        });
    DiscoveredEffect found = AnswerFor(*member, dataset_);
    found.description = GeometrySentence(geometry_->report);
    return found;
  }

  void FillNoise() {
    NoiseFound& noise = result_.noise;
    const GapNoise& found = selection_.noise;
    noise.scale = found.factor.size() == 3 ? std::sqrt(found.factor[0]) : 1.0;
    const std::size_t n = found.factor.size();
    noise.robot_position = std::sqrt(found.factor[n - 2]);
    noise.robot_orientation = std::sqrt(found.factor[n - 1]);
    noise.tail_freedom = found.tail_freedom;
    noise.correlation = found.correlation;
    noise.shape_scale = std::sqrt(found.shape_factor);
  }

  void FillPoses() {
    const JointFit alone =
        FitJointly(problem_.linear, selection_.noise, {}, kPrior, Eigen::VectorXd());
    for (std::size_t k = 0; k < data_.rows.size(); ++k) {
      PoseGap pose;
      pose.row = data_.rows[k];
      pose.label = dataset_.robot_poses.rows[pose.row].label;
      const auto at = 6 * static_cast<Eigen::Index>(k);
      pose.before = alone.left.segment<6>(at);
      pose.after = refit_.problem.linear.error.segment<6>(at);
      if (!problem_.legs_by_error.empty()) {
        pose.legs_before = problem_.legs_by_error[k] * pose.before;
        pose.legs_after = problem_.legs_by_error[k] * pose.after;
        pose.leg_lengths = data_.visits[pose.row].lengths;
      }
      pose.weight = std::min(1.0, selection_.noise.weight[static_cast<Eigen::Index>(k)]);
      result_.poses.push_back(std::move(pose));
    }
  }

  Verdict VerdictOf() const {
    const bool none = result_.effects.empty();
    if (none) {
      const Estimate& alone = result_.base_and_tool;
      // Heavy tails and a robot that does not repeat are noise, and are said to be.
      const bool is_stated = !alone.noise.estimated;
      const bool has_gap = is_stated && result_.noise.scale > kMuchMore &&
                           ChiSquareTail(alone.chi_square, alone.degrees_of_freedom) < kGapIsThere;
      return has_gap ? Verdict::kUndecided : Verdict::kAgrees;
    }
    const bool has_unknown =
        std::any_of(result_.effects.begin(), result_.effects.end(), [](const auto& e) {
          return e.effect.name == kUnknownEffect;
        });
    const bool stopped_early =
        HasGeometry() ? !geometry_->report.is_complete : selection_.steps.back().added >= 0;
    return has_unknown || stopped_early ? Verdict::kPartlyExplained : Verdict::kExplained;
  }

  const Dataset& dataset_;
  const DiscoverOptions& options_;
  Observations observations_;
  std::vector<Pose3d> reported_;
  std::vector<FaultFound> faults_;
  bool robot_is_mended_ = false;
  GapData data_;
  FormLibrary library_;
  GapProblem problem_;
  Selection selection_;
  HeldOut held_;
  std::optional<UnknownGeometry> geometry_;
  Refit refit_;
  Discovery result_;
};

}  // namespace

Discovery Discover(const Dataset& dataset, const DiscoverOptions& options) {
  const std::vector<FaultFound> swaps = FindSwappedMarkers(dataset);
  if (swaps.empty()) return Discoverer(dataset, {}, options).Run();
  Dataset mended = dataset;
  for (const FaultFound& swap : swaps)
    mended.measurement = MendedMeasurement(*mended.measurement, {swap.effect});
  return Discoverer(mended, swaps, options).Run();
}

}  // namespace hexcal
