// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/robust_start.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "estimator/closed_form.h"
#include "estimator/polish.h"
#include "estimator/start.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

using Rows = std::vector<Observation>;

constexpr std::size_t kSubsetSize = 4;
// Enough that with 45 % of bad poses one in 10^8 runs has no good subset.
constexpr int kSubsets = 200;
constexpr std::size_t kFinalists = 10;
constexpr int kMaxConcentrations = 20;
constexpr std::size_t kSearchPoses = 400;
// As in estimator/start.cc: what starts in the right basin leaves less of the squared spread.
constexpr double kGoodMisfit = 1e-2;
constexpr double kMedianOfChi3 = 1.5381722544550522;  // of the length of a 3-d unit normal

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

struct Candidate {
  BaseAndTool mounts;
  NoiseLevels levels;
  double score = std::numeric_limits<double>::infinity();
  std::vector<double> squared_distances;  // a pose
};

class Search {
 public:
  Search(const Observations& observations, const std::optional<NoiseLevels>& noise)
      : observations_(observations),
        rows_(observations.items),
        noise_(noise),
        rounding_(Rounding(rows_)) {}

  Candidate Evaluate(const BaseAndTool& mounts) const {
    Candidate c{mounts, {}, 0.0, {}};
    std::vector<Vector6d> errors;
    errors.reserve(rows_.size());
    for (const Observation& o : rows_)
      errors.push_back(PoseError(mounts, o.base_from_platform, o.world_from_tool));
    c.levels = noise_.value_or(NoiseLevels{MedianLevel(errors, 0, rounding_.position),
                                           MedianLevel(errors, 3, rounding_.orientation)});
    for (std::size_t i = 0; i < rows_.size(); ++i)
      c.squared_distances.push_back((Whitener(c, i) * errors[i]).squaredNorm());
    c.score = IsKnown() ? Median(c.squared_distances)
                        : std::log(c.levels.position) + std::log(c.levels.orientation);
    if (!std::isfinite(c.score)) c.score = std::numeric_limits<double>::infinity();
    return c;
  }

  std::vector<std::size_t> Nearest(const Candidate& c) const {
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(HalfOfPoses(order.size()));
    std::nth_element(order.begin(), end - 1, order.end(), [&c](std::size_t a, std::size_t b) {
      return c.squared_distances[a] < c.squared_distances[b];
    });
    order.erase(end, order.end());
    std::sort(order.begin(), order.end());
    return order;
  }

  // Fits the nearest half until that stays the same half or no longer gets nearer.
  Candidate Concentrated(Candidate c) const {
    std::vector<std::size_t> nearest = Nearest(c);
    for (int k = 0; k < kMaxConcentrations; ++k) {
      Rows kept;
      std::vector<Matrix6d> whiteners;
      for (const std::size_t i : nearest) {
        kept.push_back(rows_[i]);
        whiteners.push_back(Whitener(c, i));
      }
      const Candidate next = Evaluate(Moved(c.mounts, StepFrom(kept, whiteners, c.mounts).y));
      if (!(next.score < c.score)) break;
      c = next;
      const std::vector<std::size_t> again = Nearest(c);
      if (again == nearest) break;
      nearest = again;
    }
    return c;
  }

  // The least of them, best first.
  std::vector<Candidate> Finalists(std::vector<Candidate> candidates) const {
    const std::size_t count = std::min(kFinalists, candidates.size());
    std::partial_sort(candidates.begin(),
                      candidates.begin() + static_cast<std::ptrdiff_t>(count),
                      candidates.end(),
                      [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
    candidates.resize(count);
    return candidates;
  }

  std::vector<Candidate> FromSubsets() const {
    std::mt19937_64 rng(1);
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<Candidate> candidates;
    for (const ClosedForm method :
         {ClosedForm::kShah, ClosedForm::kParkMartin, ClosedForm::kPositions})
      candidates.push_back(Evaluate(SolveClosedForm(method, rows_)));
    for (int k = 0; k < kSubsets; ++k) {
      Rows four;
      for (std::size_t i = 0; i < kSubsetSize; ++i) {
        std::swap(order[i], order[i + rng() % (order.size() - i)]);
        four.push_back(rows_[order[i]]);
      }
      candidates.push_back(Evaluate(SolveClosedForm(ClosedForm::kShah, four)));
    }
    return Finalists(std::move(candidates));
  }

  // Where closed forms fail (rotations about one axis, see FindStart), the half that is nearest so
  // far is worth a search of its own.
  Candidate Best() const {
    std::vector<Candidate> finalists = FromSubsets();
    for (Candidate& c : finalists) c = Concentrated(std::move(c));
    Candidate best = Finalists(std::move(finalists)).front();
    Rows kept;
    for (const std::size_t i : Nearest(best)) kept.push_back(rows_[i]);
    if (MisfitOf(kept, best.mounts).Total() < kGoodMisfit) return best;
    Candidate other = Concentrated(Evaluate(FindStart(kept)));
    return other.score < best.score ? other : best;
  }

 private:
  bool IsKnown() const { return noise_ || observations_.tool_noise_is_known; }

  double MedianLevel(const std::vector<Vector6d>& errors, int first, double at_least) const {
    std::vector<double> lengths;
    lengths.reserve(errors.size());
    for (const Vector6d& e : errors) lengths.push_back(e.segment<3>(first).norm());
    return std::max(SigmaFromMedian(Median(std::move(lengths)), rows_.size()), at_least);
  }

  Matrix6d Whitener(const Candidate& c, std::size_t i) const {
    return WhitenerOf(
        ErrorCovariance(rows_[i], observations_, c.mounts.platform_from_tool, c.levels));
  }

  const Observations& observations_;
  const Rows& rows_;
  const std::optional<NoiseLevels>& noise_;
  NoiseLevels rounding_;
};

// At most kSearchPoses of them, evenly taken.
Observations Thinned(const Observations& observations) {
  Observations few = observations;
  if (few.items.size() <= kSearchPoses) return few;
  few.items.clear();
  for (std::size_t k = 0; k < kSearchPoses; ++k)
    few.items.push_back(observations.items[k * observations.items.size() / kSearchPoses]);
  return few;
}

}  // namespace

std::size_t HalfOfPoses(std::size_t poses) { return std::min(poses, (poses + 3) / 2); }

RobustStart FindRobustStart(const Observations& observations,
                            const std::optional<NoiseLevels>& noise) {
  CHECK_GE(observations.items.size(), kSubsetSize);
  const Observations few = Thinned(observations);
  const BaseAndTool mounts = Search(few, noise).Best().mounts;
  const Search all(observations, noise);
  const Candidate best = all.Concentrated(all.Evaluate(mounts));
  return {best.mounts, best.levels, all.Nearest(best)};
}

std::vector<double> SquaredSigmas(const Observations& observations,
                                  const std::optional<NoiseLevels>& noise,
                                  const BaseAndTool& mounts) {
  return Search(observations, noise).Evaluate(mounts).squared_distances;
}

double SigmaFromMedian(double median, std::size_t n) {
  const double free_share = std::max(1.0 - 2.0 / static_cast<double>(n), 0.1);
  return median / (kMedianOfChi3 * std::sqrt(free_share));
}

}  // namespace hexcal
