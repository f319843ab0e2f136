// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "apps/progress.h"

namespace hexcal {

// One bar for each of the things that are done one after another.
class StageBars {
 public:
  explicit StageBars(bool quiet) : quiet_(quiet) {}

  void Update(std::string_view label, long done, long of) {
    if (label != label_) {
      bar_.reset();
      label_ = label;
      bar_ = std::make_unique<Progress>(label_, quiet_);
    }
    bar_->Update(done, of);
  }

 private:
  bool quiet_;
  std::string label_;
  std::unique_ptr<Progress> bar_;
};

}  // namespace hexcal
