// SPDX-License-Identifier: BSD-3-Clause
#include "model/place_visits.h"

#include <glog/logging.h>

#include <numeric>
#include <string_view>
#include <vector>

namespace hexcal {
namespace {

bool IsVelocity(std::string_view name) {
  return name.size() == 2 && (name[0] == 'v' || name[0] == 'w') && name[1] >= 'x' && name[1] <= 'z';
}

double ValueAfter(const Covariate& covariate) {
  const std::vector<double>& values = covariate.values;
  if (covariate.name == "time") return values.back();
  if (IsVelocity(covariate.name)) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

PlaceVisits::PlaceVisits(const Dataset& dataset, const HexapodGeometry* hexapod, const Pose3d& home)
    : last_row_(static_cast<int>(dataset.robot_poses.rows.size()) - 1) {
  CHECK_GE(last_row_, 0);
  one_row_.gravity_in_base = dataset.gravity_in_base;
  one_row_.robot_poses.rows.emplace_back();
  for (const Covariate& covariate : dataset.robot_poses.covariates) {
    // Where a recorded move went says nothing of this one.
    if (covariate.name.rfind("direction_", 0) == 0) continue;
    one_row_.robot_poses.covariates.push_back(covariate);
    one_row_.robot_poses.covariates.back().values = {ValueAfter(covariate)};
  }
  if (hexapod == nullptr) return;
  hexapod_ = *hexapod;
  hexapod_->home = home;
}

Visit PlaceVisits::At(const Pose3d& base_from_platform) const {
  const std::vector<Pose3d> reported = {base_from_platform};
  Visit visit = VisitSequence(one_row_, hexapod_ ? &*hexapod_ : nullptr, reported).Next();
  // Steps and drifts count rows where no time was recorded.
  visit.row = last_row_;
  if (hexapod_)
    for (double& direction : visit.direction)
      if (direction == 0.0) direction = 1.0;
  return visit;
}

}  // namespace hexcal
