// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/screening.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "discovery/answers.h"
#include "discovery/joint_fit.h"
#include "discovery/prepare.h"
#include "discovery/told_part.h"

namespace hexcal {
namespace {

constexpr const char* kHeldByMounts = "other poses: base and tool explain it as well in these";
constexpr const char* kNotTold =
    "other poses or markers: of its best form these tell nothing to ten plausible sizes";

class Screener {
 public:
  Screener(const Investigation& work, const std::vector<Eigen::Vector3d>& p_in_tool)
      : work_(work),
        problem_(work.problem.linear),
        p_in_tool_(p_in_tool),
        units_(UnitsOf(work.library)),
        sites_(SitesOf(work.library)) {}

  Screening Run() {
    Screening result;
    result.alpha = work_.options.alpha;
    const SelectionStep& step = work_.selection.steps.front();
    result.hypotheses = static_cast<int>(step.families.size());
    std::set<int> seen;
    for (std::size_t k = 0; k < step.families.size(); ++k) {
      const int family = step.families[k].family;
      seen.insert(family);
      const bool is_named = step.added == step.families[k].best.form;
      if (problem_.families[family].is_described && !is_named) continue;
      Hypothesis one = Of(step, k, is_named);
      if (one.told == 0) {
        result.not_testable.push_back({one.name, kNotTold});
        continue;
      }
      result.tested.push_back(std::move(one));
      if (is_named)
        result.named.push_back(Sentence(step.families[k].best.form, result.tested.back()));
    }
    std::stable_sort(
        result.tested.begin(), result.tested.end(), [](const Hypothesis& a, const Hypothesis& b) {
          if (a.is_named != b.is_named) return a.is_named;
          return a.p_value != b.p_value ? a.p_value < b.p_value : a.log10_p < b.log10_p;
        });
    for (const FaultFound& fault : work_.faults)
      result.named.push_back(AnswerFor(fault.effect, work_.dataset).description);
    for (const auto& [name, needs] : work_.library.not_testable)
      result.not_testable.push_back({name, needs});
    for (std::size_t f = 0; f < problem_.families.size(); ++f)
      if (!problem_.families[f].is_described && seen.count(static_cast<int>(f)) == 0)
        result.not_testable.push_back({problem_.families[f].name, kHeldByMounts});
    return result;
  }

 private:
  Hypothesis Of(const SelectionStep& step, std::size_t k, bool is_named) const {
    const Score& score = step.families[k].best;
    const Form& form = problem_.forms[score.form];
    Hypothesis one;
    one.name = problem_.families[form.family].name;
    one.is_named = is_named;
    one.parameters = score.rank;
    one.gain = score.gain;
    one.p_value = is_named ? step.p_value : step.p_values[k];
    one.log10_p = score.log10_p;
    one.own_p_value = std::pow(10.0, score.log10_p);
    const auto rows = static_cast<double>(problem_.error.size() + Freedom(problem_.shape_freedom));
    one.aic_change = 2.0 * score.rank - score.gain;
    one.bic_change = std::log(rows) * score.rank - score.gain;
    const JointFit fit =
        FitJointly(problem_, work_.selection.noise, {score.form}, kWidePrior, Eigen::VectorXd());
    const FormDefinition& definition = work_.library.forms[score.form];
    // What is named has told something.
    const ToldPart part = ToldPartOf(
        fit, kWidePrior * problem_.scale.segment(form.first, form.size), is_named ? 1 : 0);
    one.directions = part.directions;
    one.told = part.told;
    const Eigen::Index largest = LargestOf(definition, form, part.coefficients);
    one.size = part.coefficients[largest];
    one.standard_uncertainty = part.StandardUncertainty(largest);
    one.unit = UnitOf(definition, largest);
    one.labels = AnswerFor(EffectOf(definition, part.coefficients), work_.dataset).labels;
    AddPoints(form, part, &one);
    return one;
  }

  // Of a compliance the first: the others are products of it with mass and height.
  Eigen::Index LargestOf(const FormDefinition& definition,
                         const Form& form,
                         const Eigen::VectorXd& coefficients) const {
    Eigen::Index largest = 0;
    if (definition.reading != FormDefinition::Reading::kCompliance)
      coefficients.cwiseAbs()
          .cwiseQuotient(problem_.scale.segment(form.first, form.size))
          .maxCoeff(&largest);
    return largest;
  }

  // A coefficient's: that of the number that it moves most.
  std::string UnitOf(const FormDefinition& definition, Eigen::Index coefficient) const {
    const EffectKind* kind = FindEffectKind(definition.effect.name);
    if (kind == nullptr || definition.directions.size() == 0) return units_[definition.family];
    Eigen::Index number = 0;
    definition.directions.col(coefficient).cwiseAbs().maxCoeff(&number);
    return std::string(kind->UnitOf(static_cast<int>(number)));
  }

  static int Freedom(const std::vector<int>& by_pose) {
    int sum = 0;
    for (const int freedom : by_pose) sum += freedom;
    return sum;
  }

  // How the tool's predicted poses change, frame T, 6 a pose, with each coefficient. What only the
  // tracker or a marker does moves no tool but by what base and tool make of it.
  Eigen::MatrixXd Moved(const Form& form, const ToldPart& part) const {
    Eigen::MatrixXd moved = problem_.nuisance * part.response;
    const std::string& site = sites_[form.family];
    if (site != "tracker" && site != "marker")
      moved += problem_.columns->middleCols(form.first, form.size);
    return moved;
  }

  void AddPoints(const Form& form, const ToldPart& part, Hypothesis* one) const {
    const Eigen::MatrixXd moved = Moved(form, part);
    const Eigen::VectorXd all = moved * part.coefficients;
    const Eigen::MatrixXd sigmas = moved * part.root;
    for (const Eigen::Vector3d& p : p_in_tool_) {
      double variance = 0.0;
      for (Eigen::Index k = 0; k < sigmas.cols(); ++k)
        variance += std::pow(RmsAt(sigmas.col(k), p), 2);
      one->at_points.push_back(RmsAt(all, p));
      one->at_points_uncertainty.push_back(std::sqrt(variance));
    }
  }

  double RmsAt(const Eigen::VectorXd& moved, const Eigen::Vector3d& p_in_tool) const {
    double squares = 0.0;
    for (int k = 0; k < problem_.poses; ++k) {
      const Vector6d d = moved.segment<6>(6 * k);
      squares += (d.head<3>() + d.tail<3>().cross(p_in_tool)).squaredNorm();
    }
    return std::sqrt(squares / std::max(problem_.poses, 1));
  }

  std::string Sentence(int form, const Hypothesis& one) const {
    const FormDefinition& definition = work_.library.forms[form];
    const DiscoveredEffect answer =
        AnswerFor(EffectOf(definition, Eigen::VectorXd::Zero(definition.size())), work_.dataset);
    if (problem_.families[definition.family].is_described)
      return fmt::format("something at the {} that follows {}", answer.site, answer.driver);
    std::string labels;
    for (const std::string& label : one.labels) labels += (labels.empty() ? "" : ", ") + label;
    return labels.empty() ? one.name : fmt::format("{} ({})", one.name, labels);
  }

  const Investigation& work_;
  const LinearProblem& problem_;
  const std::vector<Eigen::Vector3d>& p_in_tool_;
  std::vector<std::string> units_, sites_;
};

// Leaves so many poses at most with what was measured of them; all rows stay, since effects
// depend on where the machine came from. Returns how many there were.
int Thin(int most, Measurement* measurement) {
  std::set<int> measured;
  for (const MeasuredPose& pose : measurement->poses) measured.insert(pose.pose);
  for (const MarkerReading& reading : measurement->readings) measured.insert(reading.pose);
  const int all = static_cast<int>(measured.size());
  const int stride = (all + most - 1) / most;
  if (stride < 2) return all;
  int place = 0;
  std::set<int> dropped;
  for (const int pose : measured)
    if (place++ % stride != 0) dropped.insert(pose);
  const auto drop = [&dropped](auto* items) {
    items->erase(std::remove_if(items->begin(),
                                items->end(),
                                [&](const auto& item) { return dropped.count(item.pose) > 0; }),
                 items->end());
  };
  drop(&measurement->poses);
  drop(&measurement->readings);
  return all;
}

}  // namespace

Screening Screen(const Dataset& dataset,
                 const DiscoverOptions& options,
                 const std::vector<Eigen::Vector3d>& p_in_tool,
                 int most_poses) {
  MendedDataset mended = MendMarkers(dataset, options);
  const int all = Thin(most_poses, &*mended.dataset.measurement);
  Investigation work{mended.dataset, options, MakeObservations(mended.dataset)};
  work.faults = mended.swaps;
  Prepare(&work);
  work.selection = SelectEffects(work, 1);
  Screening result = Screener(work, p_in_tool).Run();
  result.poses = work.problem.linear.poses;
  result.of = all;
  return result;
}

}  // namespace hexcal
