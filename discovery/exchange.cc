// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/exchange.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

constexpr int kSweeps = 8;
constexpr double kBetter = 1e-9;  // an exchange gains at least so much

// The goal's models as some poses leave them.
class GoalState {
 public:
  GoalState(const DesignGoal& goal, const DesignRows& rows, const std::vector<int>& poses)
      : goal_(goal), parameters_(goal.parameters, rows, poses) {
    for (const auto& forms : goal.pairs) {
      pairs_.emplace_back();
      for (const DesignModel& form : forms) pairs_.back().emplace_back(form, rows, poses);
    }
  }

  double Value() const {
    return Sum([](const DesignState& state) { return state.value(); });
  }
  double With(int pose) const {
    return Sum([pose](const DesignState& state) { return state.With(pose); });
  }

 private:
  template <typename Read>
  double Sum(const Read& read) const {
    double sum = goal_.parameter_weight > 0.0 ? goal_.parameter_weight * read(parameters_) : 0.0;
    for (const std::vector<DesignState>& forms : pairs_) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const DesignState& form : forms) nearest = std::min(nearest, read(form));
      sum += std::log1p(nearest / kApart);
    }
    return sum;
  }

  const DesignGoal& goal_;
  DesignState parameters_;
  std::vector<std::vector<DesignState>> pairs_;
};

struct Best {
  int pose = -1;
  double value = -std::numeric_limits<double>::infinity();
};

Best BestOf(const GoalState& state,
            const std::vector<int>& candidates,
            const std::vector<int>& chosen) {
  Best best;
  for (const int pose : candidates) {
    if (std::find(chosen.begin(), chosen.end(), pose) != chosen.end()) continue;
    const double value = state.With(pose);
    if (value > best.value) best = {pose, value};
  }
  return best;
}

std::vector<int> Together(const std::vector<int>& known, const std::vector<int>& chosen) {
  std::vector<int> all = known;
  all.insert(all.end(), chosen.begin(), chosen.end());
  return all;
}

}  // namespace

std::vector<int> ChoosePoses(const DesignGoal& goal,
                             const DesignRows& rows,
                             const std::vector<int>& known,
                             const std::vector<int>& candidates,
                             int count,
                             const std::function<void(int done, int of)>& progress) {
  CHECK_LE(static_cast<std::size_t>(count), candidates.size());
  std::vector<int> chosen;
  const int steps = count * (1 + kSweeps);
  while (static_cast<int>(chosen.size()) < count) {
    if (progress) progress(static_cast<int>(chosen.size()), steps);
    const GoalState state(goal, rows, Together(known, chosen));
    chosen.push_back(BestOf(state, candidates, chosen).pose);
  }
  double value = UtilityOf(goal, rows, Together(known, chosen));
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool has_changed = false;
    for (int i = 0; i < count; ++i) {
      if (progress) progress(count * (1 + sweep) + i, steps);
      std::vector<int> others = chosen;
      others.erase(others.begin() + i);
      const GoalState state(goal, rows, Together(known, others));
      const Best best = BestOf(state, candidates, chosen);
      if (best.pose < 0 || !(best.value > value + kBetter)) continue;
      chosen[i] = best.pose;
      value = best.value;
      has_changed = true;
    }
    if (!has_changed) break;
  }
  return chosen;
}

double UtilityOf(const DesignGoal& goal, const DesignRows& rows, const std::vector<int>& poses) {
  return GoalState(goal, rows, poses).Value();
}

}  // namespace hexcal
