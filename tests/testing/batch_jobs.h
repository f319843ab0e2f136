// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "batch/job.h"

namespace hexcal::testing {

// A job of quick tasks with three rows each, whose cells are of all kinds, awkward ones among them.
class ToyJob : public Job {
 public:
  explicit ToyJob(std::int64_t tasks) : tasks_(tasks) {}

  const std::vector<Column>& columns() const override {
    static const std::vector<Column> columns = {
        {"count", CellKind::kInteger}, {"x", CellKind::kReal}, {"note", CellKind::kText}};
    return columns;
  }
  std::int64_t tasks() const override { return tasks_; }
  int outcomes_per_task() const override { return 3; }

  std::vector<Outcome> Work(std::int64_t task) const override {
    ++worked;
    std::mt19937_64 rng(static_cast<std::uint64_t>(task));
    std::vector<Outcome> outcomes(3);
    for (Outcome& outcome : outcomes) {
      const double x = std::ldexp(std::uniform_real_distribution<double>(-1, 1)(rng),
                                  static_cast<int>(rng() % 200) - 100);
      outcome.cells = {static_cast<std::int64_t>(rng() % 1000), x, "task " + std::to_string(task)};
    }
    outcomes[0].cells[1] = std::numeric_limits<double>::quiet_NaN();
    outcomes[1].cells[2] = std::string("=a,\"b\"\n#c");
    if (task % 7 == 3) outcomes[2] = {RowStatus::kFailed, "no luck", {}};
    return outcomes;
  }

  mutable std::atomic<std::int64_t> worked{0};

 private:
  std::int64_t tasks_;
};

inline Batch ToyBatch(std::int64_t tasks, std::string digest = "d") {
  return {"toy", std::move(digest), std::make_unique<ToyJob>(tasks)};
}
inline const ToyJob& ToyOf(const Batch& batch) { return static_cast<const ToyJob&>(*batch.job); }

}  // namespace hexcal::testing
