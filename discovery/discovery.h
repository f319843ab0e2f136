// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discovery/given_state.h"
#include "estimator/estimate.h"
#include "model/effect.h"
#include "model/machine.h"

namespace hexcal {

// How far prediction and measurement are apart: RMS of position, m, and orientation, rad, over
// poses; chi-square of all whitened residuals.
struct GapSize {
  double rms_position = 0.0;
  double rms_orientation = 0.0;
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
};

struct Gap {
  GapSize before, after;                  // on the data: base and tool alone, the grown model
  GapSize heldout_before, heldout_after;  // on poses that neither fit nor selection saw
  GapSize noise_floor;                    // what noise of measurement and parameters would leave
};

struct Rival {
  std::string name;
  std::string why;  // and what would tell it apart
};

// What was added to the model, or the best description of an unknown.
struct DiscoveredEffect {
  Effect effect;                    // its name is the answer's; of an unknown see `description`
  std::string site, driver, shape;  // words of docs/effects.md
  std::vector<std::string> labels;  // "leg 3", "tool/t2"
  double p_value = 1.0;             // family-wise, that so much appears by chance
  double log10_p = 0.0;             // of its own test: keeps its digits where p is 0
  double gap_closed = 0.0;          // of the held-out position gap, by the steps up to this
  std::vector<Rival> could_also_be;
  std::string description;  // one sentence with size and place
};

struct CandidateScore {
  std::string name;
  std::vector<int> index;
  double score = 0.0;    // evidence against none: 2 ln of the Bayes factor
  double p_value = 1.0;  // of its own test
  double log10_p = 0.0;
};

struct Step {
  std::vector<CandidateScore> candidates;  // best first
  std::string added;                       // empty: nothing more
  double p_value = 1.0;                    // family-wise, of the best
  GapSize after;                           // on the data, with what was added
};

struct NotTestable {
  std::string name;
  std::string needs;
};

// The smallest size that would be found with 80 % power.
struct Detectable {
  std::string name;
  std::vector<int> index;
  std::string unit;
  double smallest = 0.0;
};

// Where the disagreement with base and tool alone sits. p-values are calibrated each by itself and
// corrected within their list.
struct WhereItem {
  std::string what;  // "pose 17", "leg 3", "base x", "time", "tracker"
  double p_value = 1.0;
  double share = 0.0;  // of the excess chi-square that it explains
};
struct Where {
  std::vector<WhereItem> poses, legs, axes, covariates, sites;
};

// Per measured pose: what pictures are drawn from.
struct PoseGap {
  std::string label;
  int row = 0;
  Vector6d before = Vector6d::Zero(), after = Vector6d::Zero();  // residuals, frame T, [m, rad]
  Vector6d legs_before = Vector6d::Zero(), legs_after = Vector6d::Zero();  // in leg space, m
  // Each of the six in its own standard deviations, by the Gaussian part of the noise that was
  // found; NaN where the fit has left next to nothing.
  Vector6d standard_before = Vector6d::Zero(), standard_after = Vector6d::Zero();
  std::optional<Vector6d> leg_lengths;  // of the reported pose, m; empty: no legs are known
  double weight = 1.0;                  // below 1: taken for an outlier in part
};

// What the noise was found to be.
struct NoiseFound {
  double scale = 1.0;              // of the stated noise
  double robot_position = 0.0;     // repeatability, 1-sigma, m
  double robot_orientation = 0.0;  // rad
  double tail_freedom = 0.0;       // of Student's t; 0: Gaussian
  double correlation = 0.0;        // from one pose to the next
  double shape_scale = 1.0;        // of the markers' misfit within their bodies, kind markers
};

// 95 % bounds of one number.
struct Bound {
  std::string name, unit;
  double value = 0.0, lower = 0.0, upper = 0.0;
};

// Errors of legs and joints of a hexapod whose geometry is not published: a class of causes, for
// the places of joints and the zeros of legs cannot be taken apart. The symmetric hexapod under it
// is determined weakly.
struct GeometryClass {
  bool is_in_model = false;   // it foretold poses better than a map of the pose did
  bool is_complete = false;   // no map of the pose explains more beside it
  std::vector<Bound> bounds;  // radii, half angles of the pairs, heights
  double yaw = 0.0;           // of the base's first pair, rad
  double error_size = 0.0;    // 1-sigma of joints and legs that the data make likely, m
  GapSize after;              // on the data
  GapSize heldout, heldout_map;
};

enum class Verdict { kAgrees, kExplained, kPartlyExplained, kUndecided };
constexpr std::string_view NameOf(Verdict verdict) {
  return verdict == Verdict::kAgrees      ? "agrees"
         : verdict == Verdict::kExplained ? "explained"
         : verdict == Verdict::kUndecided ? "undecided"
                                          : "partly explained";
}

// An effect of the model that discovery was started from.
struct GivenEffect {
  DiscoveredEffect now;  // as these data tell it; of its statistics nothing
  std::optional<GivenJudgement>
      judgement;  // nothing of a fault of the data, which is taken as it is
};

struct Discovery {
  Verdict verdict = Verdict::kAgrees;
  std::vector<NotTestable> not_testable;
  std::vector<Detectable> detectable;
  Gap gap;
  std::vector<GivenEffect> given;             // with a model: its effects
  std::vector<DiscoveredEffect> effects;      // found
  std::optional<GeometryClass> leg_geometry;  // where a gap follows the pose and no leg is known
  std::vector<Step> steps;
  Where where;
  NoiseFound noise;
  std::vector<PoseGap> poses;
  Observations observations;           // a pose each, faults of the data mended
  Estimate base_and_tool;              // without effects
  Estimate estimate;                   // with them: result.json
  std::vector<IterationRecord> refit;  // of base, tool and effects together; empty: none
  Machine machine;                     // model.yaml
  std::vector<std::string> warnings;
};

}  // namespace hexcal
