// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/design_model.h"
#include "discovery/gap_model.h"
#include "discovery/gap_noise.h"
#include "discovery/model_forms.h"
#include "discovery/planned_visits.h"

namespace hexcal {

// An effect of a model and a rival: what poses must tell apart. forms: of a library, each entry one
// alternative of several forms taken together; none: nothing that could ever tell.
struct RivalModel {
  int effect = 0;  // of the scene's
  std::string name;
  std::vector<std::vector<int>> forms;
};

// The forms of a plan's problems: each effect's signal, then each effect's free numbers, then forms
// of rivals.
struct PlanForms {
  FormLibrary library;
  std::vector<Eigen::VectorXd> signals;  // values of the effects' signal columns
  std::vector<RivalModel> rivals;        // forms: of the library
};

// The effects' own forms alone.
PlanForms OwnForms(const std::vector<Effect>& effects);

// With the rivals that the measured poses leave: those of discovery's could_also_be (RivalsOf), and
// the gauges. Of a rival with many forms the nearest few stand for all.
PlanForms WithRivals(const PlanScene& scene,
                     const GapData& data,
                     const Mounts& mounts,
                     const GapNoise& noise);

// The models of a design of which rows were made of the library's problem.
struct DesignModels {
  DesignModel parameters;                       // free numbers of effects, then the 12
  std::vector<DesignModel> effects;             // against none, an entry an effect
  std::vector<std::vector<DesignModel>> pairs;  // an entry a rival, one a form
};
DesignModels MakeDesignModels(const PlanForms& forms,
                              const std::vector<Effect>& effects,
                              const LinearProblem& problem,
                              const DesignRows& rows);

}  // namespace hexcal
