// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/form_library.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discovery/described_forms.h"
#include "discovery/search_grid.h"

namespace hexcal {
namespace {

std::vector<int> Numbered(int count) {
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 1);
  return all;
}

// Adds the forms of one effect to the library.
class FormMaker {
 public:
  FormMaker(const Dataset& dataset,
            const std::vector<Visit>& visits,
            const std::vector<int>& rows,
            const EffectKind& kind,
            int family,
            FormLibrary* library)
      : dataset_(dataset),
        visits_(visits),
        rows_(rows),
        kind_(kind),
        family_(family),
        library_(library),
        reference_(ReferenceFor(kind, visits, dataset)) {}

  void Add() {
    if (kind_.name == "leg_periodic") return AddPeriodic();
    if (kind_.name == "leg_compliance") return AddCompliance();
    const ParameterKind* search = nullptr;
    for (const ParameterKind& parameter : kind_.parameters) {
      if (parameter.is_search) search = &parameter;
      if (parameter.is_per_marker) return AddMarkers();
    }
    if (search != nullptr) return AddSearched(*search);
    if (kind_.site == "leg" && kind_.size() == kNumLegs) return AddLegs(1);
    if (kind_.size() == 3 * kNumLegs) return AddLegs(3);
    AddPlain(AllNumbers(), {}, Zero({}), 0.0);
  }

 private:
  Effect Zero(const std::vector<int>& index) const {
    Effect effect;
    effect.name = std::string(kind_.name);
    effect.index = index;
    effect.parameters = Eigen::VectorXd::Zero(kind_.SizeFor(index));
    effect.reference = reference_;
    return effect;
  }

  // Numbers of parameters that are neither searched for nor mute by themselves.
  std::vector<int> AllNumbers() const {
    std::vector<int> numbers;
    for (int n = 0; n < kind_.size(); ++n) {
      const ParameterKind& parameter = kind_.ParameterOf(n);
      if (!parameter.is_search && parameter.acts_alone) numbers.push_back(n);
    }
    return numbers;
  }

  // One column a number. Returns the form's place in the list.
  int AddPlain(const std::vector<int>& numbers,
               const std::vector<int>& index,
               Effect effect,
               double log_prior) {
    FormDefinition form;
    form.family = family_;
    form.effect = std::move(effect);
    form.effect.index = index;
    form.directions.setZero(form.effect.parameters.size(),
                            static_cast<Eigen::Index>(numbers.size()));
    form.scale.resize(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      form.directions(numbers[k], k) = 1.0;
      form.scale[k] = kind_.ScaleOf(numbers[k]);
    }
    form.log_prior = log_prior;
    library_->forms.push_back(std::move(form));
    return static_cast<int>(library_->forms.size()) - 1;
  }

  // Each leg its own, one leg alone (columns of the former), and, for legs, all alike.
  void AddLegs(int numbers_a_leg) {
    const double third = std::log(1.0 / 3.0);
    const int each = AddPlain(AllNumbers(), Numbered(kNumLegs), Zero({}), third);
    for (int leg = 0; leg < kNumLegs; ++leg) {
      std::vector<int> numbers(numbers_a_leg);
      std::iota(numbers.begin(), numbers.end(), numbers_a_leg * leg);
      const int one = AddPlain(numbers, {leg + 1}, Zero({}), third - std::log(6.0));
      library_->forms[one].shares = each;
      library_->forms[one].shares_from = numbers_a_leg * leg;
    }
    if (numbers_a_leg > 1) return;
    const int alike = AddPlain({0}, Numbered(kNumLegs), Zero({}), third);
    library_->forms[alike].directions = Eigen::VectorXd::Ones(kNumLegs);
  }

  void AddSearched(const ParameterKind& search) {
    const std::vector<double> grid = GridFor(kind_, search, visits_, rows_, reference_);
    if (grid.empty()) return;  // too few poses to have a step between them
    const int offset = kind_.OffsetOf(search.name);
    // A straight line is what is meant first; its bent variants share what is left.
    const bool has_line = grid[0] == 0.0;
    const double many = static_cast<double>(grid.size()) - (has_line ? 1.0 : 0.0);
    for (const double value : grid) {
      Effect effect = Zero({});
      effect.parameters[offset] = value;
      const double share = !has_line ? 1.0 / many : value == 0.0 ? 0.9 : 0.1 / many;
      AddPlain(AllNumbers(), {}, std::move(effect), std::log(share));
    }
  }

  void AddMarkers() {
    const auto& bodies = dataset_.measurement->bodies;
    const int count =
        static_cast<int>(bodies[0].markers.size()) + static_cast<int>(bodies[1].markers.size());
    const ParameterKind* search = nullptr;
    for (const ParameterKind& parameter : kind_.parameters)
      if (parameter.is_search) search = &parameter;
    std::vector<double> grid = {0.0};
    if (search != nullptr) grid = GridFor(kind_, *search, visits_, rows_, reference_);
    const double log_prior = -std::log(static_cast<double>(grid.size()) * count);
    for (int marker = 1; marker <= count; ++marker)
      for (const double value : grid) {
        Effect effect = Zero({marker});
        if (search != nullptr) effect.parameters[kind_.OffsetOf(search->name)] = value;
        const int first = kind_.OffsetOf("offset");
        AddPlain({first, first + 1, first + 2}, {marker}, std::move(effect), log_prior);
      }
  }

  void AddPeriodic() {
    const int period = kind_.OffsetOf("period");
    const double size = kind_.ScaleOf(kind_.OffsetOf("amplitude"));
    const std::vector<double> grid =
        GridFor(kind_, kind_.ParameterOf(period), visits_, rows_, reference_);
    const double third = std::log(1.0 / 3.0) - std::log(static_cast<double>(grid.size()));
    for (const double value : grid) {
      FormDefinition form;
      form.family = family_;
      form.reading = FormDefinition::Reading::kPeriodic;
      form.effect = Zero(Numbered(kNumLegs));
      form.effect.parameters[period] = value;
      form.scale = Eigen::VectorXd::Constant(2 * kNumLegs, size);
      form.log_prior = third;
      const int each = static_cast<int>(library_->forms.size());
      library_->forms.push_back(form);
      form.scale = Eigen::VectorXd::Constant(2, size);
      library_->forms.push_back(form);  // all alike
      form.shares = each;
      form.log_prior = third - std::log(6.0);
      for (int leg = 0; leg < kNumLegs; ++leg) {
        form.effect.index = {leg + 1};
        form.shares_from = 2 * leg;
        library_->forms.push_back(form);
      }
    }
  }

  void AddCompliance() {
    FormDefinition form;
    form.family = family_;
    form.reading = FormDefinition::Reading::kCompliance;
    form.effect = Zero({});
    form.scale.resize(3);
    for (int k = 0; k < 3; ++k) form.scale[k] = kind_.ScaleOf(k);
    form.log_prior = std::log(0.5);
    const int whole = static_cast<int>(library_->forms.size());
    library_->forms.push_back(form);
    form.scale.conservativeResize(1);
    form.shares = whole;
    library_->forms.push_back(form);
  }

  const Dataset& dataset_;
  const std::vector<Visit>& visits_;
  const std::vector<int>& rows_;
  const EffectKind& kind_;
  const int family_;
  FormLibrary* library_;
  const EffectReference reference_;
};

}  // namespace

FormLibrary MakeFormLibrary(const Dataset& dataset,
                            const std::vector<Visit>& visits,
                            const std::vector<int>& rows) {
  FormLibrary library;
  const Drivers drivers = DriversOf(dataset);
  for (const EffectKind& kind : EffectKinds()) {
    const std::string missing = MissingFor(kind, drivers);
    if (!missing.empty()) {
      library.not_testable.emplace_back(std::string(kind.name), missing);
      continue;
    }
    if (kind.IsFault()) continue;
    const int family = static_cast<int>(library.families.size());
    library.families.push_back({std::string(kind.name), kind.log_prior, false});
    FormMaker(dataset, visits, rows, kind, family, &library).Add();
  }
  AddDescribedForms(dataset, visits, rows, &library);
  return library;
}

}  // namespace hexcal
