// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/cross_validation.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "estimator/rms.h"

namespace hexcal {
namespace {

constexpr std::size_t kFewestPoses = 3;

}  // namespace

std::vector<int> DrawFolds(std::size_t poses, int folds, std::uint64_t seed) {
  const std::size_t k = std::min(poses, static_cast<std::size_t>(folds));
  if (k < 2 || poses - (poses + k - 1) / k < kFewestPoses) return {};
  std::vector<std::size_t> order(poses);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 rng(seed);
  // std::shuffle may differ between libraries.
  for (std::size_t i = poses - 1; i > 0; --i) std::swap(order[i], order[rng() % (i + 1)]);
  std::vector<int> fold_of_pose(poses);
  for (std::size_t i = 0; i < poses; ++i) fold_of_pose[order[i]] = static_cast<int>(i % k);
  return fold_of_pose;
}

HeldOutError CrossValidate(const Observations& observations,
                           const std::vector<int>& fold_of_pose,
                           const std::function<MethodFit(const Observations&)>& fit) {
  const int folds = *std::max_element(fold_of_pose.begin(), fold_of_pose.end()) + 1;
  HeldOutError error;
  RmsError rms;
  for (int fold = 0; fold < folds; ++fold) {
    Observations kept = observations;
    kept.items.clear();
    for (std::size_t i = 0; i < fold_of_pose.size(); ++i)
      if (fold_of_pose[i] != fold) kept.items.push_back(observations.items[i]);
    const MethodFit found = fit(kept);
    error.not_converged += !found.converged;
    for (std::size_t i = 0; i < fold_of_pose.size(); ++i) {
      const Observation& o = observations.items[i];
      if (fold_of_pose[i] == fold)
        rms.Add(PoseError(found.mounts, o.base_from_platform, o.world_from_tool));
    }
  }
  error.position = rms.Position();
  error.orientation = rms.Orientation();
  return error;
}

}  // namespace hexcal
