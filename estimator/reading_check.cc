// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/reading_check.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "estimator/quantiles.h"
#include "estimator/reading_fit.h"

namespace hexcal {
namespace {

constexpr int kMostBadOf = 10;  // one in so many
constexpr int kMostRounds = 50, kFewestRounds = 3;
constexpr int kMostChecks = 2000000;  // readings, of all rounds together
// So many poses that contradict the others are asked whether one reading is the reason.
constexpr std::size_t kMostAsked = 20;
// What is significant and at least this part of the worst goes out together with it, one of a pose.
constexpr double kFarOff = 0.5;

class Snooping {
 public:
  Snooping(const MarkerObservations& markers,
           const MarkerSolution& solution,
           const std::vector<bool>& cut,
           const ReadingOptions& options)
      : markers_(markers),
        options_(options),
        fit_(markers, solution, cut),
        out_(markers.data.readings.size(), false) {
    for (std::size_t i = 0; i < markers.data.poses.size(); ++i)
      if (markers.item_of_pose[i] >= 0)
        tested_ += markers.data.poses[i].end - markers.data.poses[i].first_base;
    of_one_ = -std::expm1(std::log1p(-options.alpha) / std::max(tested_, 1));
  }

  ReadingSearch Run() {
    if (tested_ == 0) return {};
    const int rounds = std::clamp(kMostChecks / tested_, kFewestRounds, kMostRounds);
    fit_.Fit(out_);
    for (int round = 0; round < rounds && TakeOut(); ++round) fit_.Fit(out_);
    for (int round = 0; round < rounds && TakeBack(); ++round) fit_.Fit(out_);
    return Describe();
  }

 private:
  bool TakeOut() {
    std::vector<const ReadingTest*> worst_first;
    for (const ReadingTest& test : fit_.tests())
      if (!out_[test.reading] && test.p_value < of_one_) worst_first.push_back(&test);
    std::sort(worst_first.begin(),
              worst_first.end(),
              [](const ReadingTest* a, const ReadingTest* b) { return a->squared > b->squared; });
    const auto most = std::max(1, tested_ / kMostBadOf);
    std::set<int> poses;
    bool any = false;
    for (const ReadingTest* test : worst_first) {
      if (test->squared < kFarOff * worst_first[0]->squared) break;
      if (std::count(out_.begin(), out_.end(), true) >= most) break;
      if (!poses.insert(test->pose).second) continue;
      out_[test->reading] = any = true;
    }
    return any;
  }

  // What another one had made look bad: the best of those that are out.
  bool TakeBack() {
    const ReadingTest* best = nullptr;
    for (const ReadingTest& test : fit_.tests())
      if (out_[test.reading] && test.p_value >= of_one_ &&
          (best == nullptr || test.p_value > best->p_value))
        best = &test;
    if (best == nullptr) return false;
    out_[best->reading] = false;
    return true;
  }

  ReadingSearch Describe() const {
    ReadingSearch search;
    search.unchecked = fit_.unchecked();
    search.basis = fit_.basis();
    const double noncentrality = ChiSquareNoncentrality(of_one_, options_.power, 3.0);
    for (const ReadingTest& test : fit_.tests()) {
      const MarkerPose& pose = markers_.data.poses[test.pose];
      const int body = test.reading < pose.first_tool ? 0 : 1;
      search.checks.push_back({static_cast<std::size_t>(markers_.item_of_pose[test.pose]),
                               markers_.labels[body][markers_.data.readings[test.reading].marker],
                               test.held_out,
                               test.squared,
                               test.unit * std::sqrt(noncentrality),
                               test.redundancy,
                               -std::expm1(tested_ * std::log1p(-test.p_value)),
                               out_[test.reading]});
    }
    return search;
  }

  const MarkerObservations& markers_;
  const ReadingOptions& options_;
  ReadingFit fit_;
  std::vector<bool> out_;
  int tested_ = 0;
  double of_one_ = 1.0;  // Sidak's level of one reading
};

}  // namespace

std::vector<ReadingCheck> ReadingSearch::Bad() const {
  std::vector<ReadingCheck> bad;
  for (const ReadingCheck& check : checks)
    if (check.is_bad) bad.push_back(check);
  std::sort(bad.begin(), bad.end(), [](const ReadingCheck& a, const ReadingCheck& b) {
    return a.squared > b.squared;
  });
  return bad;
}

ReadingSearch FindBadReadings(const MarkerObservations& markers,
                              const BaseAndTool& near,
                              const std::vector<Outlier>& outliers,
                              const ReadingOptions& options) {
  CHECK(options.alpha > 0.0 && options.alpha < 1.0);
  MarkerSolverOptions solver;
  solver.threads = options.threads;
  const MarkerSolution solution = SolveMarkers(markers, near, solver);
  if (!solution.solution.converged) return {};
  const std::vector<bool> none(markers.data.poses.size(), false);
  if (outliers.empty()) return Snooping(markers, solution, none, options).Run();
  const bool is_one_asked = outliers.size() <= kMostAsked;
  const ReadingSearch first =
      is_one_asked ? Snooping(markers, solution, none, options).Run() : ReadingSearch{};
  std::vector<bool> cut = none;
  for (const Outlier& outlier : outliers) {
    const auto in_pose = [&](const ReadingCheck& c) { return c.is_bad && c.item == outlier.index; };
    if (std::count_if(first.checks.begin(), first.checks.end(), in_pose) == 1) continue;
    for (std::size_t i = 0; i < cut.size(); ++i)
      if (markers.item_of_pose[i] == static_cast<int>(outlier.index)) cut[i] = true;
  }
  return std::count(cut.begin(), cut.end(), true) == 0
             ? first
             : Snooping(markers, solution, cut, options).Run();
}

std::string ReadingWords(const ReadingCheck& reading, const std::string& label) {
  return fmt::format("{} in pose {}: {:.3g} sigma off ({:.3g} mm)",
                     reading.marker,
                     label,
                     std::sqrt(reading.squared),
                     1e3 * reading.held_out.norm());
}

}  // namespace hexcal
