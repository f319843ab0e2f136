// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "report/audit.h"

namespace hexcal::testing {

// examples/neurobot by poses, with 1000 repetitions.
struct AuditedExample {
  Dataset dataset;
  Observations observations;
  Estimate estimate;
  Comparison comparison;

  AuditInput Input(const std::optional<Requirements>& requirements) const {
    return {dataset,
            observations,
            {},
            {dataset.name, "nonlinear", "pose", ""},
            estimate,
            comparison,
            requirements,
            std::nullopt,
            1};
  }
};
AuditedExample AuditExample();

// examples/neurobot/requirement.yaml.
Requirements ExampleRequirements();

}  // namespace hexcal::testing
