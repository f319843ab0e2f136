// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "discovery/discover.h"
#include "hidden/hidden_case.h"

namespace hexcal::hidden {

// One entry of what a discovery found.
struct Found {
  std::string name;
  std::vector<int> index;
  std::vector<std::string> could_also_be;
  double p_value = 1.0;
  bool Covers(const std::string& other) const;  // its name, or in its class
};

// One dataset that was searched, beside its truth.
struct Trial {
  std::string cell, name;
  std::vector<std::string> truth;  // the hidden effects' own names
  bool is_listed = true;
  std::vector<std::string> right;  // of the first effect: HiddenEffect::right
  std::vector<int> carriers;       // of the first effect
  std::vector<Found> found;
  std::string verdict, error;
  double first_p = 1.0;  // family-wise, of the first search
  double seconds = 0.0;  // of one processor
  // Root mean square distance of the tool's position in the held-out rows from the truth, m: base
  // and tool alone, the discovered machine, a refit that knows the effects.
  double before = 0.0, after = 0.0, oracle = 0.0;
  double noise = 0.0;  // of a tool's position as measured, m: what held-out readings add to these

  bool IsAlarm() const { return verdict != "agrees" || !found.empty(); }
  bool NamesFirst() const;      // the first name is the first truth's
  bool ClassIsRight() const;    // or the truth is in the class of the first
  bool SetIsExact() const;      // the names are the truths
  bool SetIsInClasses() const;  // as many names as truths, each truth in a class
  bool AddsWrong() const;       // a name that is no truth and has none in its class
  bool HasCarrier() const;      // the right name carries the right leg, joint or marker
  bool HasCarrierAlone() const;
  bool IsUnknownOrRightSite() const;
  bool IsConfidentlyWrong() const;  // one name, no class, of another site
  bool IsWrong() const;             // a name or a class, none of it unknown or of the site
  bool IsWorse() const;             // held out, by more than 2 % against the truth
  bool IsWorseAsMeasured() const;   // and against readings with their noise, as users see it
  double GapClosed() const;  // of what the oracle closes; NaN where that is too little to tell
};

// as_poses: kind poses, and no held-out poses.
Trial RunTrial(const std::string& cell,
               const Case& made,
               const DiscoverOptions& options,
               bool as_poses);

}  // namespace hexcal::hidden
