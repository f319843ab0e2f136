// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/findings.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discovery/answers.h"
#include "discovery/geometry_words.h"
#include "discovery/given.h"
#include "discovery/rivals.h"
#include "discovery/where.h"
#include "estimator/quantiles.h"
#include "estimator/standard_residual.h"
#include "model/described_effect.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostCandidates = 12;
constexpr double kGapIsThere = 1e-6;  // p of the residuals under the stated noise
constexpr double kMuchMore = 1.5;     // of the stated noise

class Findings {
 public:
  Findings(const Investigation& work, Discovery* result) : work_(work), result_(result) {}

  void Run() {
    FillSteps();
    FillGap();
    AddGeometryStep();
    FillGiven();
    FillEffects();
    std::vector<std::string> labels;
    for (const int row : work_.data.rows)
      labels.push_back(work_.dataset.robot_poses.rows[row].label);
    result_->where = Localise(work_.problem.linear,
                              work_.selection.noise,
                              work_.selection.steps.front(),
                              labels,
                              SitesOf(work_.library),
                              DriversOf(work_.library));
    result_->detectable = DetectableSizes(work_.problem.linear,
                                          work_.selection.noise,
                                          work_.selection.chosen,
                                          work_.options.alpha,
                                          UnitsOf(work_.library));
    FillNoise();
    FillPoses();
    result_->verdict = VerdictOf();
  }

 private:
  void FillSteps() {
    std::vector<int> so_far;
    for (const SelectionStep& from : work_.selection.steps) {
      Step step;
      for (std::size_t k = 0; k < from.families.size() && k < kMostCandidates; ++k) {
        const auto& family = from.families[k];
        step.candidates.push_back({work_.library.families[family.family].name,
                                   work_.problem.linear.forms[family.best.form].index,
                                   family.evidence,
                                   std::pow(10.0, family.log10_p),
                                   family.log10_p});
      }
      if (from.added >= 0) {
        step.added = NameOfForm(from.added);
        so_far.push_back(from.added);
      }
      step.p_value = from.p_value;
      const JointFit fit = FitJointly(
          work_.problem.linear, work_.selection.noise, so_far, kWidePrior, Eigen::VectorXd());
      step.after =
          SizeOf(work_.problem.linear, work_.selection.noise, fit.left, ParametersOf(so_far));
      result_->steps.push_back(std::move(step));
    }
  }

  // What took the place of the map, after the steps that led to it.
  void AddGeometryStep() {
    if (!work_.HasGeometry()) return;
    Step step;
    step.added = "base_joint_offset";
    step.p_value = result_->steps.front().p_value;
    step.after = result_->gap.after;
    result_->steps.push_back(std::move(step));
  }

  int ParametersOf(const std::vector<int>& forms) const {
    int count = static_cast<int>(work_.problem.linear.nuisance.cols());
    for (const int f : forms) count += work_.problem.linear.forms[f].size;
    return count;
  }

  std::string NameOfForm(int form) const {
    const Family& family = work_.library.families[work_.problem.linear.forms[form].family];
    return family.is_described ? std::string(kUnknownEffect) : family.name;
  }

  void FillGap() {
    const JointFit alone =
        FitJointly(work_.problem.linear, work_.selection.noise, {}, kWidePrior, Eigen::VectorXd());
    result_->gap.before =
        SizeOf(work_.problem.linear, work_.selection.noise, alone.left, ParametersOf({}));
    result_->gap.after = SizeOf(
        work_.problem.linear,
        work_.selection.noise,
        work_.refit.problem.linear.error,
        work_.HasGeometry()
            ? 6 * work_.problem.linear.poses - work_.geometry->report.after.degrees_of_freedom
            : ParametersOf(work_.selection.chosen));
    result_->gap.heldout_before = work_.held.before;
    result_->gap.heldout_after = work_.held.after;
    // Noise of the measurement and of all that was fitted, at each pose.
    double position = 0.0, orientation = 0.0;
    const LinearProblem& last = work_.refit.problem.linear;
    const Eigen::MatrixXd columns = last.With(AllForms(last)).nuisance;
    for (int k = 0; k < work_.problem.linear.poses; ++k) {
      const Eigen::MatrixXd by = columns.middleRows(6 * k, 6);
      const Matrix6d root = work_.selection.noise.Root(work_.problem.linear, k);
      const Matrix6d covariance =
          root * root.transpose() + by * work_.refit.covariance * by.transpose();
      position += covariance.topLeftCorner<3, 3>().trace();
      orientation += covariance.bottomRightCorner<3, 3>().trace();
    }
    GapSize& floor = result_->gap.noise_floor;
    floor.rms_position = std::sqrt(position / work_.problem.linear.poses);
    floor.rms_orientation = std::sqrt(orientation / work_.problem.linear.poses);
    floor.degrees_of_freedom = result_->gap.after.degrees_of_freedom;
    floor.chi_square = floor.degrees_of_freedom;
  }

  double ClosedBy(double after) const {
    const auto square = [](double x) { return x * x; };
    const double before = square(result_->gap.heldout_before.rms_position);
    const double floor = square(result_->gap.noise_floor.rms_position);
    return before > floor ? (before - square(after)) / (before - floor) : 0.0;
  }

  void FillGiven() {
    for (const Effect& fault : work_.given_faults)
      result_->given.push_back({AnswerFor(fault, work_.dataset), std::nullopt});
    const auto judgements = JudgeGiven(work_.refit, work_.given, work_.options.alpha);
    for (std::size_t e = 0; e < work_.given.size(); ++e)
      result_->given.push_back({AnswerFor(work_.refit.effects[e], work_.dataset), judgements[e]});
  }

  void FillEffects() {
    for (const FaultFound& fault : work_.faults) {
      DiscoveredEffect found = AnswerFor(fault.effect, work_.dataset);
      found.log10_p = -fault.gain / (2.0 * std::log(10.0));
      found.p_value = std::pow(10.0, found.log10_p);
      result_->effects.push_back(std::move(found));
    }
    const bool kind_poses = work_.dataset.measurement->kind == Measurement::Kind::kPoses;
    const std::vector<std::vector<Rival>> rivals =
        RivalsOf(work_.problem.linear, work_.selection.noise, work_.selection.chosen, kind_poses);
    std::size_t refitted = work_.given.size();
    bool is_class_there = false;
    for (std::size_t k = 0; k < work_.selection.chosen.size(); ++k) {
      const int form = work_.selection.chosen[k];
      const bool follows_pose = FollowsPose(work_.library.forms[form].effect);
      const bool is_class = follows_pose && work_.HasGeometry();
      if (is_class && is_class_there) continue;
      if (work_.HasGeometry() && !follows_pose && !work_.geometry->Keeps(form)) continue;
      DiscoveredEffect found =
          is_class ? GeometryAnswer() : AnswerFor(work_.refit.effects[refitted++], work_.dataset);
      found.p_value = work_.selection.p_values[k];
      found.log10_p = work_.selection.log10_p[k];
      found.gap_closed =
          ClosedBy(is_class ? work_.held.after.rms_position : work_.held.after_steps[k + 1]);
      if (!is_class) found.could_also_be = rivals[k];
      if (follows_pose && work_.geometry && !is_class_there) {
        const std::vector<Rival> more = GeometryRivals(work_.geometry->report);
        found.could_also_be.insert(found.could_also_be.begin(), more.begin(), more.end());
        is_class_there = true;
      }
      result_->effects.push_back(std::move(found));
    }
  }

  // The class under the name of its most probable member.
  DiscoveredEffect GeometryAnswer() const {
    const auto member = std::find_if(
        work_.refit.effects.begin(), work_.refit.effects.end(), [](const Effect& effect) {
          return effect.name == "base_joint_offset";
        });
    DiscoveredEffect found = AnswerFor(*member, work_.dataset);
    found.description = GeometrySentence(work_.geometry->report);
    return found;
  }

  void FillNoise() {
    NoiseFound& noise = result_->noise;
    const GapNoise& found = work_.selection.noise;
    noise.scale = found.factor.size() == 3 ? std::sqrt(found.factor[0]) : 1.0;
    const std::size_t n = found.factor.size();
    noise.robot_position = std::sqrt(found.factor[n - 2]);
    noise.robot_orientation = std::sqrt(found.factor[n - 1]);
    noise.tail_freedom = found.tail_freedom;
    noise.correlation = found.correlation;
    noise.shape_scale = std::sqrt(found.shape_factor);
  }

  static std::vector<int> AllForms(const LinearProblem& problem) {
    std::vector<int> all(problem.forms.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  // Without the weight: an outlier is to stand out.
  Vector6d Standard(const LinearProblem& problem,
                    std::size_t pose,
                    const Vector6d& error,
                    const Eigen::MatrixXd& columns,
                    const Eigen::MatrixXd& covariance) const {
    const auto k = static_cast<Eigen::Index>(pose);
    const Matrix6d root = work_.selection.noise.Root(problem, static_cast<int>(pose));
    const Matrix6d noise = work_.selection.noise.weight[k] * root * root.transpose();
    return StandardResidual(error, noise, columns * covariance * columns.transpose());
  }

  void FillPoses() {
    const LinearProblem &first = work_.problem.linear, &last = work_.refit.problem.linear;
    const JointFit alone =
        FitJointly(first, work_.selection.noise, {}, kWidePrior, Eigen::VectorXd());
    const Eigen::MatrixXd grown = last.With(AllForms(last)).nuisance;
    for (std::size_t k = 0; k < work_.data.rows.size(); ++k) {
      PoseGap pose;
      pose.row = work_.data.rows[k];
      pose.label = work_.dataset.robot_poses.rows[pose.row].label;
      const auto at = 6 * static_cast<Eigen::Index>(k);
      pose.before = alone.left.segment<6>(at);
      pose.after = last.error.segment<6>(at);
      pose.standard_before =
          Standard(first, k, pose.before, first.nuisance.middleRows(at, 6), alone.covariance);
      pose.standard_after =
          Standard(last, k, pose.after, grown.middleRows(at, 6), work_.refit.covariance);
      if (!work_.problem.legs_by_error.empty()) {
        pose.legs_before = work_.problem.legs_by_error[k] * pose.before;
        pose.legs_after = work_.problem.legs_by_error[k] * pose.after;
        pose.leg_lengths = work_.data.visits[pose.row].lengths;
      }
      pose.weight = std::min(1.0, work_.selection.noise.weight[static_cast<Eigen::Index>(k)]);
      result_->poses.push_back(std::move(pose));
    }
  }

  Verdict VerdictOf() const {
    const bool none = result_->effects.empty();
    if (none) {
      const Estimate& alone = work_.given.empty() ? result_->base_and_tool : result_->estimate;
      // Heavy tails and a robot that does not repeat are noise, and are said to be.
      const bool is_stated = !alone.noise.estimated;
      const bool has_gap = is_stated && result_->noise.scale > kMuchMore &&
                           ChiSquareTail(alone.chi_square, alone.degrees_of_freedom) < kGapIsThere;
      return has_gap ? Verdict::kUndecided : Verdict::kAgrees;
    }
    const bool has_unknown =
        std::any_of(result_->effects.begin(), result_->effects.end(), [](const auto& e) {
          return e.effect.name == kUnknownEffect;
        });
    const bool stopped_early = work_.HasGeometry() ? !work_.geometry->report.is_complete
                                                   : work_.selection.steps.back().added >= 0;
    return has_unknown || stopped_early ? Verdict::kPartlyExplained : Verdict::kExplained;
  }

  const Investigation& work_;
  Discovery* result_;
};

}  // namespace

void FillFindings(const Investigation& work, Discovery* result) { Findings(work, result).Run(); }

}  // namespace hexcal
