// SPDX-License-Identifier: BSD-3-Clause
#include "testing/audits.h"

namespace hexcal::testing {

AuditedExample AuditExample() {
  AuditedExample example;
  example.dataset = ReadDataset(std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml", true);
  example.observations = MakeObservations(example.dataset);
  example.estimate = Calibrate(example.observations, {}, {});
  CompareOptions options;
  options.draws = 1000;
  options.keep_draws = true;
  options.starts = 0;
  example.comparison = Compare(example.observations, {}, options);
  return example;
}

Requirements ExampleRequirements() {
  return ReadRequirements(std::string(HEXCAL_EXAMPLES) + "/neurobot/requirement.yaml");
}

}  // namespace hexcal::testing
