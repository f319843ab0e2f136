// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/effect.h"

namespace hexcal {

// What the functions of several effects share.

inline constexpr double kStandardGravity = 9.80665;  // m/s^2

// CHECKs that the reference is there.
const std::vector<double>& Reference(const EffectInput& input, const std::string& name);
// home_lengths of the reference, else of the visit, m.
LegLengths HomeLengths(const EffectInput& input);
// What drifts and steps follow: time, s, or the row, as the reference says.
double TimeOrRow(const EffectInput& input);
// From the reference temperature, K.
double Warming(const EffectInput& input);
bool Carries(const EffectInput& input, int leg);  // leg from 0; an empty index is all

inline double Sign(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : 0.0); }

// Adds factor * twist[0..5].
template <typename T, typename Factor>
void AddTwist(const T* twist, const Factor& factor, Eigen::Matrix<T, 6, 1>& sum) {
  for (int k = 0; k < 6; ++k) sum[k] += factor * twist[k];
}

// Rows of the table that stand in more than one group.
ParameterKind Twist(std::string_view unit, double scale, double rotation_scale);
ParameterKind Searched(std::string_view name, std::string_view unit, double scale);

// The table's groups, a file each: every kind's row beside its function.
std::vector<EffectKind> LegEffects();
std::vector<EffectKind> ForceEffects();
std::vector<EffectKind> JointEffects();
std::vector<EffectKind> MountEffects();
std::vector<EffectKind> TrackerEffects();
std::vector<EffectKind> MarkerEffects();
std::vector<EffectKind> DataFaults();

}  // namespace hexcal
