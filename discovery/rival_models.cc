// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/rival_models.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "discovery/experiments.h"
#include "discovery/rivals.h"
#include "discovery/score.h"

namespace hexcal {
namespace {

constexpr std::size_t kMostForms = 4;  // of a rival

// From this family on; -1: none.
int FamilyOf(const FormLibrary& library, const std::string& name, std::size_t from) {
  for (std::size_t f = from; f < library.families.size(); ++f)
    if (library.families[f].name == name && !library.families[f].is_described)
      return static_cast<int>(f);
  return -1;
}

// Own forms in front, of families behind the library's.
FormLibrary Joined(const FormLibrary& own, const FormLibrary& library) {
  FormLibrary all = own;
  const int shift = static_cast<int>(own.forms.size());
  const int families = static_cast<int>(own.families.size());
  all.families.insert(all.families.end(), library.families.begin(), library.families.end());
  for (FormDefinition form : library.forms) {
    form.family += families;
    if (form.shares >= 0) form.shares += shift;
    all.forms.push_back(std::move(form));
  }
  return all;
}

// Searches the measured poses for what else an effect of the model could be.
class RivalSearch {
 public:
  RivalSearch(const PlanScene& scene,
              const GapData& data,
              const Mounts& mounts,
              const GapNoise& noise)
      : scene_(scene), noise_(noise), own_(OwnForms(scene.effects)) {
    library_ = Joined(own_.library, MakeFormLibrary(scene.dataset, data.visits, data.rows));
    problem_ = MakeGapProblem(data, mounts, scene.effects, library_).linear;
  }

  PlanForms Run() {
    for (int e = 0; e < Effects(); ++e) AddRivals(e);
    std::vector<int> forms(own_.library.forms.size());
    std::iota(forms.begin(), forms.end(), 0);
    for (const RivalModel& rival : rivals_)
      for (const auto& alternative : rival.forms)
        forms.insert(forms.end(), alternative.begin(), alternative.end());
    std::vector<int> places;
    PlanForms all = {SomeForms(library_, forms, &places), own_.signals, rivals_};
    std::size_t at = own_.library.forms.size();
    for (RivalModel& rival : all.rivals)
      for (auto& alternative : rival.forms)
        for (int& form : alternative) form = places[at++];
    return all;
  }

 private:
  int Effects() const { return static_cast<int>(scene_.effects.size()); }

  // The problem as it is without the effect, the other effects' numbers free; own forms cannot be
  // chosen.
  LinearProblem Without(int e) const {
    std::vector<int> others;
    for (int other = 0; other < Effects(); ++other)
      if (other != e) others.push_back(Effects() + other);
    LinearProblem problem = problem_.With(others);
    const Form& signal = problem.forms[e];
    for (int k = 0; k < signal.size; ++k) {
      const int column = signal.first + k;
      problem.error += own_.signals[e][k] * problem.columns->col(column);
      if (problem.shape_of[column] >= 0)
        problem.shape_error +=
            own_.signals[e][k] * problem.shape_columns->col(problem.shape_of[column]);
    }
    problem.forms.erase(problem.forms.begin(), problem.forms.begin() + 2 * Effects());
    return problem;
  }

  void AddRivals(int e) {
    const Effect& effect = scene_.effects[e];
    std::set<std::string> in_gauges;
    for (const Gauge& gauge : GaugesOf(effect, scene_.dataset)) {
      RivalModel rival = {e, gauge.rival, {}};
      const std::vector<int> together = Together(gauge.together);
      if (!together.empty()) rival.forms = {together};
      rivals_.push_back(rival);
      for (const Gauge::Part& part : gauge.together) in_gauges.insert(part.name);
    }
    const int family = effect.name == kUnknownEffect
                           ? DescriptionOf(effect)
                           : FamilyOf(library_, effect.name, own_.library.families.size());
    if (family < 0) return;
    const LinearProblem problem = Without(e);
    const Scorer scorer(problem, noise_);
    int chosen = -1;
    for (const auto& score : scorer.Families())
      if (score.family == family) chosen = score.best.form;
    if (chosen < 0) return;
    const std::vector<std::vector<Rival>> found = RivalsOf(problem, noise_, {chosen}, false);
    for (const Rival& rival : found.front()) {
      if (in_gauges.count(rival.name) > 0 || IsInModel(rival.name)) continue;
      const int other = FamilyOf(library_, rival.name, own_.library.families.size());
      if (other < 0) continue;  // a description has no law to plan against
      rivals_.push_back({e, rival.name, Likeliest(scorer, problem, other)});
    }
  }

  // The family of what has no name but a site, a driver and a power.
  int DescriptionOf(const Effect& effect) const {
    for (std::size_t f = own_.library.forms.size(); f < library_.forms.size(); ++f) {
      const Effect& form = library_.forms[f].effect;
      if (form.name != kUnknownEffect || form.found != effect.found) continue;
      const auto power = form.reference.find("power"), asked = effect.reference.find("power");
      if (power != form.reference.end() && asked != effect.reference.end() &&
          power->second == asked->second)
        return library_.forms[f].family;
    }
    return -1;
  }

  bool IsInModel(const std::string& name) const {
    return std::any_of(scene_.effects.begin(), scene_.effects.end(), [&](const Effect& effect) {
      return effect.name == name;
    });
  }

  // One form of each of these effects; none if one is missing.
  std::vector<int> Together(const std::vector<Gauge::Part>& parts) const {
    std::vector<int> forms;
    for (const Gauge::Part& part : parts) {
      const int family = FamilyOf(library_, part.name, own_.library.families.size());
      int best = -1;
      for (std::size_t f = 0; f < library_.forms.size(); ++f) {
        const FormDefinition& form = library_.forms[f];
        if (form.family != family || form.effect.index.size() == 1) continue;
        const int size = form.size(), now = best < 0 ? -1 : library_.forms[best].size();
        if (best < 0 || (part.is_each ? size > now : size < now)) best = static_cast<int>(f);
      }
      if (best < 0) return {};
      forms.push_back(best);
    }
    return forms;
  }

  // The forms of a family for which the measured poses speak most, as forms of the library.
  std::vector<std::vector<int>> Likeliest(const Scorer& scorer,
                                          const LinearProblem& problem,
                                          int family) const {
    std::vector<std::pair<double, int>> order;
    for (std::size_t f = 0; f < problem.forms.size(); ++f) {
      const Score& score = scorer.scores()[f];
      if (problem.forms[f].family != family || score.rank == 0) continue;
      order.emplace_back(-0.5 * score.evidence - problem.forms[f].log_prior, static_cast<int>(f));
    }
    std::sort(order.begin(), order.end());
    if (order.size() > kMostForms) order.resize(kMostForms);
    std::vector<std::vector<int>> forms;
    for (const auto& [evidence, form] : order) forms.push_back({form + 2 * Effects()});
    return forms;
  }

  const PlanScene& scene_;
  const GapNoise& noise_;
  const PlanForms own_;
  FormLibrary library_;
  LinearProblem problem_;
  std::vector<RivalModel> rivals_;
};

// Columns of some forms side by side.
Eigen::MatrixXd ColumnsOf(const LinearProblem& problem,
                          const DesignRows& rows,
                          const std::vector<int>& forms) {
  Eigen::Index width = 0;
  for (const int form : forms) width += problem.forms[form].size;
  Eigen::MatrixXd columns(rows.columns.rows(), width);
  Eigen::Index at = 0;
  for (const int f : forms) {
    const Form& form = problem.forms[f];
    columns.middleCols(at, form.size) = rows.columns.middleCols(form.first, form.size);
    at += form.size;
  }
  return columns;
}

Eigen::MatrixXd Beside(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd both(a.rows(), a.cols() + b.cols());
  both << a, b;
  return both;
}

}  // namespace

PlanForms OwnForms(const std::vector<Effect>& effects) {
  PlanForms own;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    EffectSignal signal = SignalOf(effects[e]);
    signal.form.family = static_cast<int>(e);
    own.library.families.push_back({effects[e].name, 0.0, false});
    own.library.forms.push_back(std::move(signal.form));
    own.signals.push_back(std::move(signal.values));
  }
  for (std::size_t e = 0; e < effects.size(); ++e) {
    FormDefinition free = FreeFormOf(effects[e]);
    free.family = static_cast<int>(e);
    own.library.forms.push_back(std::move(free));
  }
  return own;
}

PlanForms WithRivals(const PlanScene& scene,
                     const GapData& data,
                     const Mounts& mounts,
                     const GapNoise& noise) {
  return RivalSearch(scene, data, mounts, noise).Run();
}

DesignModels MakeDesignModels(const PlanForms& forms,
                              const std::vector<Effect>& effects,
                              const LinearProblem& problem,
                              const DesignRows& rows) {
  const int count = static_cast<int>(effects.size());
  DesignModels models;
  std::vector<int> free(count);
  std::iota(free.begin(), free.end(), count);
  const Eigen::MatrixXd of_effects = ColumnsOf(problem, rows, free);
  models.parameters.columns = Beside(of_effects, rows.nuisance);
  models.parameters.nuisances = static_cast<int>(of_effects.cols());
  models.parameters.prior.setZero(models.parameters.columns.cols());
  Eigen::Index at = 0;
  for (const int form : free)
    for (const double scale : forms.library.forms[form].scale) {
      if (scale > 0.0) models.parameters.prior[at] = 1.0 / (scale * scale);
      ++at;
    }
  for (int e = 0; e < count; ++e) {
    DesignModel alone;
    std::vector<int> others = free;
    others.erase(others.begin() + e);
    alone.columns = Beside(rows.nuisance, ColumnsOf(problem, rows, others));
    alone.signal = ColumnsOf(problem, rows, {e}) * forms.signals[e];
    models.effects.push_back(std::move(alone));
  }
  for (const RivalModel& rival : forms.rivals) {
    models.pairs.emplace_back();
    for (const std::vector<int>& alternative : rival.forms) {
      DesignModel against = models.effects[rival.effect];
      against.columns = Beside(against.columns, ColumnsOf(problem, rows, alternative));
      models.pairs.back().push_back(std::move(against));
    }
  }
  return models;
}

}  // namespace hexcal
