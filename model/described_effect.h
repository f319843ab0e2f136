// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/effect.h"
#include "model/pose_map.h"

namespace hexcal {

// An effect without a name (`unknown`): at a site, a power of a driver,
//   coefficients[6] * ((driver - centre) / half_range)^power,
// as a twist of the base or of the tool [m, rad], or added to the legs' lengths, m. `found` holds
// site and driver in words, the reference centre, half_range and power.

// Drivers that every visit may have, in the driver's own unit; x..rz are the translation and the
// rotation vector of the reported pose. A covariate without a meaning of its own is one by its
// name.
const std::vector<std::string>& DriverNames();
bool IsDriverName(const std::string& driver);
// One value a leg; the same six where the driver is not of the legs. NaN: not known.
Vector6d DriverOf(const Visit& visit, const std::string& driver);

// With zero coefficients.
Effect DescribedEffect(const std::string& site,
                       const std::string& driver,
                       int power,
                       double centre,
                       double half_range);

// A pose map as an effect: site platform, driver pose. Coefficients term by term, without the
// constant term, which the tool's mount is as well.
Effect PoseMapEffect(const PoseMap& map);
bool IsPoseMap(const Effect& effect);
PoseMap PoseMapOf(const Effect& effect);

// Adds factor[k] times the effect of a coefficient 1 for each k.
void AddDescribed(const Effect& effect,
                  const Eigen::VectorXd& factor,
                  const Visit& visit,
                  Corrections<double>* corrections);

}  // namespace hexcal
