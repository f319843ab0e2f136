// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hidden/noise.h"
#include "hidden/pose_fit.h"

namespace hexcal::hidden {

struct CaseOptions {
  // clean | any (a listed effect, one after another) | pair (two listed ones) | unlisted | the name
  // of an effect, listed or not | two names with a + between.
  std::string kind = "any";
  double snr = 12.0;  // of each effect, pose_fit.h's Snr
  Level level = Level::kMarkers;
  Regime regime = Regime::kWhite;
  SceneOptions scene;
  DetailOptions detail;
};

struct Case {
  std::string name;
  Scene scene;
  std::vector<HiddenEffect> effects;
  std::vector<Reading> readings;  // of the measured rows
};

// Case `number` of a series; equal options give equal cases. std::runtime_error for a kind that is
// none, or where no scene makes the effects plausible at this snr.
Case MakeCase(const CaseOptions& options, std::uint64_t series, std::uint64_t number);

// Draws an effect of this name, listed or not.
HiddenEffect DrawNamed(const std::string& name,
                       const Scene& scene,
                       const DetailOptions& detail,
                       Dice* dice);

// Names that mean nearly the same disagreement by design: leg geometry. Two of them are not hidden
// together.
bool AreAlike(const std::string& a, const std::string& b);

}  // namespace hexcal::hidden
