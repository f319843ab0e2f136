// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "discovery/discover.h"
#include "discovery/discovery.h"

namespace hexcal {

// Each effect that could be missing, tested by itself against base and tool (and the effects of a
// model): what the first step of discovery computes, before anything is refitted.
struct Hypothesis {
  std::string name;                 // of the table of effects
  std::vector<std::string> labels;  // "leg 3", "tool/t2": in its best form
  int parameters = 0;               // determined ones; degrees of freedom of the change
  double gain = 0.0;                // fall of chi-square, of the noise that was found
  double p_value = 1.0;             // that chance explains so much, all hypotheses paid for
  double own_p_value = 1.0;         // of its best form's test alone
  double log10_p = 0.0;             // of the latter: keeps its digits where that is 0
  // Directions among its numbers, and those that the data tell (told_part.h). What follows is of
  // these alone, without a prior.
  int directions = 0, told = 0;
  // Its largest coefficient in plausible sizes; SI.
  double size = 0.0, standard_uncertainty = 0.0;
  std::string unit;
  double aic_change = 0.0, bic_change = 0.0;  // below zero: for the effect; its search not paid for
  // RMS over the measured poses of how far its neglect puts each point, base and tool adjusted, and
  // of how uncertain (1-sigma) that displacement is, m.
  std::vector<double> at_points, at_points_uncertainty;
  bool is_named = false;  // discovery would add it to the model
};

struct Screening {
  double alpha = 0.01;    // chance that anything is named in data that lack nothing
  int poses = 0, of = 0;  // measured poses that were used: of many, evenly some
  int hypotheses = 0;     // families that were tried, descriptions without a cause among them
  std::vector<Hypothesis> tested;         // best first; a description only where it is named
  std::vector<NotTestable> not_testable;  // wholly; in part: Hypothesis::told
  std::vector<std::string> named;         // one sentence each, faults of the data among them
};

// p_in_tool: the points. A fraction of Discover's time, as nothing is refitted. InputError as
// Discover; the model of the options has no pose map.
// most_poses: time and memory grow with the poses; of more, so many or fewer are taken evenly.
Screening Screen(const Dataset& dataset,
                 const DiscoverOptions& options,
                 const std::vector<Eigen::Vector3d>& p_in_tool,
                 int most_poses = 200);

}  // namespace hexcal
