// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "discovery/discovery.h"
#include "discovery/gap_model.h"
#include "discovery/refit.h"
#include "discovery/select.h"

namespace hexcal {

// Where the hexapod's legs are not published and the gap follows the pose, two models rival: a
// smooth map of the pose (a form of the library), and a symmetric hexapod with errors in its legs
// and joints.
struct UnknownGeometry {
  GeometryClass report;     // but for the map and the decision; sizes under the selection's noise
  std::vector<int> others;  // chosen forms that stay: they do not follow the pose and are needed
  HexapodGeometry hexapod;  // nominal, with its home
  Mounts mounts;
  std::vector<Effect> effects;            // of the others, then leg_offset and both joint offsets
  double prior_width = 0.0;               // of the errors, in units of their plausible size
  GapNoise noise;                         // with the errors in the model
  GapSize heldout_before, heldout_after;  // under that noise

  bool Keeps(int form) const {
    return std::find(others.begin(), others.end(), form) != others.end();
  }
};

// Nothing where legs are known, no chosen form follows the pose, or no hexapod explains anything.
// mounts: where the problem was made. folds: below 2, nothing is held out.
std::optional<UnknownGeometry> FindUnknownGeometry(const GapData& data,
                                                   const Mounts& mounts,
                                                   const GapProblem& problem,
                                                   const FormLibrary& library,
                                                   const Selection& selection,
                                                   int folds,
                                                   std::uint64_t seed);

// Whether it is to take the map's place: it foretells poses better, and leaves nothing that follows
// the pose or foretells them much better. heldout and heldout_map are known.
bool Wins(const GeometryClass& geometry);

// Whether this is the name of one of the errors.
bool IsGeometryError(const std::string& name);

// Whether a form describes the gap by the pose alone.
bool FollowsPose(const Effect& effect);

// The machine with this hexapod, exactly. data: gets the hexapod and its visits.
Refit RefitGeometry(const UnknownGeometry& geometry, GapData* data);

}  // namespace hexcal
