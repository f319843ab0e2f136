// SPDX-License-Identifier: BSD-3-Clause
#include "apps/audit_screening.h"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "apps/discover.h"
#include "estimator/rounding_noise.h"
#include "report/global_test.h"

namespace hexcal {
namespace {

// Three poses leave six numbers to base and tool's twelve: their noise alone asked for an effect in
// four of ten measurements.
constexpr std::size_t kFewestScreened = 4;

}  // namespace

void ScreenFor(const std::optional<Machine>& model, StageBars* bars, AuditInput* input) {
  if (!input->estimate.IsTrustworthy()) return;
  if (IsOnlyRounding(input->observations, input->estimate.noise)) {
    input->why_not_screened = kOnlyRounding;
    return;
  }
  const std::size_t poses = input->observations.items.size();
  if (poses < kFewestScreened) {
    input->why_not_screened =
        fmt::format("{} poses are too few to tell an effect from the noise", poses);
    return;
  }
  if (model && model->pose_map) {
    input->why_not_screened = "the model has a pose map, from which discovery does not start";
    return;
  }
  DiscoverOptions options = DiscoverOptionsFromFlags();
  options.model = model;
  options.progress = [bars](const char* stage, int done, int of) { bars->Update(stage, done, of); };
  std::vector<Eigen::Vector3d> points;
  if (input->requirements)
    for (const NamedPoint& point : input->requirements->points) points.push_back(point.p_in_tool);
  if (points.empty()) points.emplace_back(Eigen::Vector3d::Zero());
  input->missing = Screen(input->dataset, options, points);
}

}  // namespace hexcal
