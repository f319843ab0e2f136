// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/select.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "discovery/family_wise.h"
#include "discovery/log_tail.h"

namespace hexcal {
namespace {

constexpr int kNoiseRounds = 3;      // noise and best form are found in turn
constexpr int kBeam = 4;             // families that may stand first of a pair
constexpr double kBeamDepth = 60.0;  // of evidence below the best: no partner makes up for more
constexpr double kKeep = 3.0;        // -log10 p that an effect must keep when others are there

using FamilyScore = Scorer::FamilyScore;

class Selector {
 public:
  Selector(const LinearProblem& problem, const Eigen::MatrixXd& trend, const SelectOptions& options)
      : problem_(problem), trend_(trend), options_(options) {}

  Selection Run() {
    for (int step = 0; step < options_.most_effects; ++step) {
      if (options_.progress) options_.progress(step);
      if (!Step(step)) break;
      if (result_.chosen.size() > 1) {
        if (result_.chosen.size() == 2 && !HasLastResort()) TryOtherPairs();
        ChooseAnew();
        if (!DropNeedless()) break;
      }
    }
    result_.noise = NoiseWith(result_.chosen);
    for (std::size_t k = 0; k < result_.chosen.size(); ++k)
      result_.log10_p.push_back(ScoreOf(k).log10_p);
    return std::move(result_);
  }

 private:
  GapNoise NoiseWith(const std::vector<int>& forms) const {
    return EstimateGapNoise(problem_.With(forms), trend_);
  }

  // Families given what is chosen, under a noise that has the best of them in its model.
  std::optional<Scorer> ScorerFor(const std::vector<int>& chosen) const {
    std::optional<Scorer> scorer;
    const LinearProblem given = problem_.With(chosen);
    GapNoise noise = EstimateGapNoise(given, trend_);
    int best = -1;
    for (int round = 0; round < kNoiseRounds; ++round) {
      scorer.emplace(given, noise);
      const std::vector<FamilyScore> families = scorer->Families();
      const int first = FirstOf(families, [](std::size_t) { return true; });
      if (first < 0 || families[first].best.form == best) break;
      best = families[first].best.form;
      std::vector<int> with = chosen;
      with.push_back(best);
      noise = NoiseWith(with);
    }
    return scorer;
  }

  // False: nothing more is there.
  bool Step(int number) {
    const std::optional<Scorer> scorer = ScorerFor(result_.chosen);
    SelectionStep step;
    step.families = scorer->Families();
    const double alpha = options_.alpha / std::pow(2.0, number);
    const int best = options_.thresholds.empty() ? Gate(*scorer, alpha, number, &step)
                                                 : GateByThresholds(number, &step);
    if (best >= 0) {
      step.added = step.families[best].best.form;
      result_.chosen.push_back(step.added);
      result_.p_values.push_back(step.p_value);
    }
    result_.steps.push_back(std::move(step));
    return best >= 0;
  }

  // The place of the family to add, or -1.
  int Gate(const Scorer& scorer, double alpha, int number, SelectionStep* step) {
    const FamilyWise null(scorer, options_.bootstraps, options_.seed + number);
    std::vector<double>& p_values = step->p_values;
    for (const FamilyScore& family : step->families) {
      step->paid.push_back(null.Paid(family.family, -family.log10_p));
      p_values.push_back(null.PValue(step->paid.back()));
    }
    if (number == 0) result_.thresholds = ThresholdsOf(null, alpha);
    if (p_values.empty()) return -1;
    step->p_value = *std::min_element(p_values.begin(), p_values.end());
    if (step->p_value > alpha) return -1;
    const int best = FirstOf(step->families, [&](std::size_t k) { return p_values[k] <= alpha; });
    if (best < 0) return best;
    step->p_value = p_values[best];
    const FamilyScore& family = step->families[best];
    const double against_correlation = ByDeviance(family.best);
    if (against_correlation < -family.log10_p)
      step->p_value = null.PValue(null.Paid(family.family, against_correlation));
    return step->p_value <= alpha ? best : -1;
  }

  // Noise that hangs together over time looks like a step or a drift, and the more so the better
  // that is fitted. So where neighbours are correlated without the form, it must also win against
  // that correlation: -log10 p of the fall of the deviance, each with its own noise. Else no bound.
  double ByDeviance(const Score& score) const {
    const GapNoise without = NoiseWith(result_.chosen);
    if (without.correlation == 0.0 && without.shape_correlation == 0.0)
      return std::numeric_limits<double>::infinity();
    std::vector<int> with = result_.chosen;
    with.push_back(score.form);
    const double fall = without.deviance - NoiseWith(with).deviance;
    if (!(fall > 0.0)) return 0.0;
    return -Log10FisherTail(fall / score.rank, score.rank, 1e6);
  }

  // The first family that passes; one of last resort only where no other does.
  template <typename Passes>
  int FirstOf(const std::vector<FamilyScore>& families, const Passes& passes) const {
    for (const bool last_resort : {false, true})
      for (std::size_t k = 0; k < families.size(); ++k)
        if (problem_.families[families[k].family].is_last_resort == last_resort &&
            families[k].evidence > 0.0 && passes(k))
          return static_cast<int>(k);
    return -1;
  }

  std::vector<double> ThresholdsOf(const FamilyWise& null, double alpha) const {
    std::vector<double> thresholds;
    for (std::size_t f = 0; f < problem_.families.size(); ++f) {
      double low = 0.0, high = 20.0;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const bool passes = null.PValue(null.Paid(static_cast<int>(f), middle)) <= alpha;
        (passes ? high : low) = middle;
      }
      thresholds.push_back(high);
    }
    return thresholds;
  }

  int GateByThresholds(int number, SelectionStep* step) const {
    const auto needed = [&](const FamilyScore& family) {
      return options_.thresholds[family.family] + number * std::log10(2.0);
    };
    const int best = FirstOf(step->families, [&](std::size_t k) {
      return -step->families[k].log10_p >= needed(step->families[k]);
    });
    if (best < 0) return best;
    const FamilyScore& family = step->families[best];
    return ByDeviance(family.best) >= needed(family) ? best : -1;
  }

  // A pair may explain more than the best single form and the best to go with it.
  void TryOtherPairs() {
    const GapNoise noise = NoiseWith(result_.chosen);
    const Scorer alone(problem_, noise);
    const std::vector<FamilyScore> firsts = alone.Families();
    double most = -1e300;
    std::vector<int> best = result_.chosen;
    int tried = 0;
    for (const FamilyScore& first : firsts) {
      if (problem_.families[first.family].is_last_resort) continue;
      const bool is_present = first.best.form == result_.chosen[0];
      if (!is_present && (tried >= kBeam || first.evidence < firsts[0].evidence - kBeamDepth))
        continue;
      ++tried;
      const Scorer given = alone.Given({first.best.form});
      const std::vector<FamilyScore> seconds = given.Families();
      const int second = FirstOf(seconds, [](std::size_t) { return true; });
      if (second < 0 || problem_.families[seconds[second].family].is_last_resort) continue;
      const double joint = first.evidence + seconds[second].evidence;
      if (joint > most) most = joint, best = {first.best.form, seconds[second].best.form};
    }
    result_.chosen = best;
  }

  bool HasLastResort() const {
    return std::any_of(result_.chosen.begin(), result_.chosen.end(), [&](int form) {
      return problem_.families[problem_.forms[form].family].is_last_resort;
    });
  }

  std::vector<int> Without(std::size_t k) const {
    std::vector<int> others = result_.chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    return others;
  }

  // Each form anew, within its family, given the others.
  void ChooseAnew() {
    for (int round = 0; round < 3; ++round) {
      bool changed = false;
      const Scorer alone(problem_, NoiseWith(result_.chosen));
      for (std::size_t k = 0; k < result_.chosen.size(); ++k) {
        const int family = problem_.forms[result_.chosen[k]].family;
        const Scorer scorer = alone.Given(Without(k));
        for (const FamilyScore& score : scorer.Families())
          if (score.family == family && score.best.form != result_.chosen[k])
            result_.chosen[k] = score.best.form, changed = true;
      }
      if (!changed) return;
    }
  }

  Score ScoreOf(std::size_t k) const {
    const LinearProblem only = problem_.With(Without(k)).Only({result_.chosen[k]});
    return Scorer(only, result_.noise.factor.empty() ? NoiseWith(result_.chosen) : result_.noise)
        .scores()[0];
  }

  // False: what was added last went again, so that no further step would find anything new.
  bool DropNeedless() {
    for (std::size_t k = result_.chosen.size(); k-- > 0;) {
      if (-ScoreOf(k).log10_p >= kKeep) continue;
      const bool was_last = k + 1 == result_.chosen.size();
      result_.chosen.erase(result_.chosen.begin() + static_cast<std::ptrdiff_t>(k));
      result_.p_values.erase(result_.p_values.begin() + static_cast<std::ptrdiff_t>(k));
      if (was_last) return false;
    }
    return true;
  }

  const LinearProblem& problem_;
  const Eigen::MatrixXd& trend_;
  const SelectOptions& options_;
  Selection result_;
};

}  // namespace

Selection Select(const LinearProblem& problem,
                 const Eigen::MatrixXd& trend,
                 const SelectOptions& options) {
  return Selector(problem, trend, options).Run();
}

}  // namespace hexcal
