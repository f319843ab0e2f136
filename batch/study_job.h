// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "batch/job.h"
#include "batch/study.h"

namespace hexcal {

// A task is one draw of one cell, given to every estimator; an outcome is what one of them made of
// it, held against the truth. Task t is draw t / cells of cell t % cells, so that whatever is done
// first tells of all cells alike, and more draws leave the earlier ones as they are.
class StudyJob : public Job {
 public:
  explicit StudyJob(Study study);

  const std::vector<Column>& columns() const override { return columns_; }
  std::int64_t tasks() const override {
    return std::int64_t{study_.draws} * static_cast<std::int64_t>(study_.cells.size());
  }
  int outcomes_per_task() const override { return static_cast<int>(study_.estimators.size()); }
  std::vector<Outcome> Work(std::int64_t task) const override;

  const Study& study() const { return study_; }

 private:
  Study study_;
  std::vector<Column> columns_;
};

}  // namespace hexcal
