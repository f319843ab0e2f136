// SPDX-License-Identifier: BSD-3-Clause
#include <glog/logging.h>

#include "estimator/calibrate.h"
#include "methods.h"

namespace hexcal {

Method Hexcal() {
  return {"hexcal", [](const Observations& observations, const BaseAndTool&) {
            return Calibration([&observations] {
              const Estimate estimate = Calibrate(observations, {}, {});
              CHECK(estimate.IsTrustworthy()) << estimate.message;
              return estimate.mounts;
            });
          }};
}

}  // namespace hexcal
