// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discovery/covariate_settings.h"
#include "estimator/observations.h"
#include "measurement/dataset.h"
#include "model/machine.h"
#include "residuals/pose_error.h"

namespace hexcal {

// What further poses are for.
enum class PlanGoal {
  kParameters,  // the 12 of base and tool
  kRivals,      // telling each effect of the model from what it could also be
};

struct PlanOptions {
  std::optional<PlanGoal> goal = {};  // empty: rivals where the model has any, else parameters
  int poses = 12;
  int pool = 300;  // poses to choose from; for rivals each with up to three settings of covariates
  // Of columns of robot_poses (not time), SI; other columns take values that the dataset has seen.
  ChosenSettings settings = {};
  std::uint64_t seed = 1;
  std::optional<NoiseLevels> noise = {};  // in place of one that is not stated
  // Called with what is done and how much there is to do, and the name of the stage.
  std::function<void(const char* stage, int done, int of)> progress = {};
};

// How an effect and a rival can be told apart.
enum class Separation {
  kAlready,    // the poses measured do
  kByPlan,     // the planned ones will
  kByMore,     // more poses like the planned ones will
  kNotByPoses  // no pose in reach does
};
constexpr std::string_view NameOf(Separation separation) {
  return separation == Separation::kAlready  ? "already"
         : separation == Separation::kByPlan ? "by this plan"
         : separation == Separation::kByMore ? "by more poses"
                                             : "not by poses";
}

// An effect of the model and what it could also be. Distances in standard deviations, of the size
// that the model gives the effect, base, tool and the model's other effects fitted along: what no
// fit of the rival explains.
struct RivalPair {
  std::string effect;
  std::vector<int> index;
  std::string rival;
  double size_before = 0.0, size_after = 0.0;  // of the effect, against none
  double before = 0.0, after = 0.0;            // against the rival
  double whole_pool = 0.0;                     // if every pose of the pool were measured
  bool is_exact = false;                       // not even then: the two are the same
  bool is_absorbed = false;                    // base and tool alone are the same as the effect
  Separation separation = Separation::kNotByPoses;
  int poses_needed = 0;    // like the planned ones; 0: no such number
  std::string experiment;  // that would do where poses do not
};

// What would lose most without a planned pose: a pair (an index into Plan::pairs), else one of the
// 12 parameters.
struct PoseReason {
  int pair = -1;
  int parameter = -1;
};

struct Plan {
  PlanGoal goal = PlanGoal::kParameters;
  RobotPoses poses;  // in the order in which to measure them
  std::vector<Pose3d> base_from_platform;
  std::vector<PoseReason> reasons;  // one a pose
  int measured = 0, pool = 0;       // poses
  // Of the 12 parameters, m and rad; NaN: not determined.
  Vector12d deviation_before = Vector12d::Zero(), deviation_after = Vector12d::Zero();
  std::vector<RivalPair> pairs;
  std::vector<std::string> warnings;
};

// The poses (and settings of the covariates) worth measuring next: from a pool that fills what the
// hexapod reaches, those that make the determinant of the 12 parameters' covariance least
// (D-optimality), or the distances between rivals large (T-optimality), beside the poses already
// measured; in random order. InputError where the dataset does not tell what is needed.
Plan MakePlan(const Dataset& dataset, const Machine& machine, const PlanOptions& options);

}  // namespace hexcal
