// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "batch/row.h"

namespace hexcal {

// Tasks 0 to tasks() - 1, each with outcomes_per_task() rows of results. What a task gives depends
// on nothing but its number: not on other tasks, threads or machines.
class Job {
 public:
  virtual ~Job() = default;
  virtual const std::vector<Column>& columns() const = 0;
  virtual std::int64_t tasks() const = 0;
  virtual int outcomes_per_task() const { return 1; }
  // From several threads at once. What the user can mend is a failed outcome, not an exception.
  virtual std::vector<Outcome> Work(std::int64_t task) const = 0;
};

// A job with all that its results must agree on. The row of outcome k of task t has index
// t * outcomes_per_task + k.
struct Batch {
  std::string name;    // of the study: letters, digits, '.', '-', '_'
  std::string digest;  // of the manifest and of what it names: other results where it differs
  std::unique_ptr<Job> job;

  std::int64_t rows() const { return job->tasks() * job->outcomes_per_task(); }
};

// The tasks that are worked on, stored and lost together: some hundred rows, or fewer where there
// would be less than 64 of them. They depend on the batch alone, not on who works on them.
class Chunks {
 public:
  struct Range {
    std::int64_t first, end;  // tasks
  };

  explicit Chunks(const Job& job)
      : tasks_(job.tasks()),
        size_(std::clamp<std::int64_t>(
            job.tasks() / kAtLeast, 1, std::max(1, kRows / job.outcomes_per_task()))) {}

  std::int64_t count() const { return (tasks_ + size_ - 1) / size_; }
  Range operator[](std::int64_t chunk) const {
    return {chunk * size_, std::min(tasks_, (chunk + 1) * size_)};
  }

 private:
  static constexpr std::int64_t kAtLeast = 64;
  static constexpr int kRows = 100;

  std::int64_t tasks_;
  std::int64_t size_;
};

}  // namespace hexcal
