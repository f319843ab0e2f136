// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "discovery/discover.h"
#include "discovery/faults.h"
#include "discovery/gap_model.h"
#include "discovery/hold_out.h"
#include "discovery/refit.h"
#include "discovery/select.h"
#include "discovery/unknown_geometry.h"
#include "estimator/observations.h"

namespace hexcal {

// Linear fits that are not chosen for their size: in plausible sizes, it holds gauges only.
inline constexpr double kWidePrior = 30.0;

// All that is known of a dataset while what is missing in its model is sought.
struct Investigation {
  const Dataset& dataset;
  const DiscoverOptions& options;
  Observations observations;          // of the mended poses
  std::vector<Pose3d> reported = {};  // base_from_platform of every row, mended
  std::vector<FaultFound> faults = {};
  bool robot_is_mended = false;
  std::vector<Effect> given = {};  // effects of the model that it starts from, as that has them
  std::vector<Effect> given_faults = {};
  GapData data = {};
  FormLibrary library = {};
  GapProblem problem = {};  // of base and tool, and what was given, alone
  Selection selection = {};
  HeldOut held = {};
  std::optional<UnknownGeometry> geometry = {};
  Refit refit = {};

  bool HasGeometry() const { return geometry && geometry->report.is_in_model; }
};

}  // namespace hexcal
