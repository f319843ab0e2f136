// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/discovery.h"
#include "discovery/form_library.h"

namespace hexcal {

// Words for what was found.

// Site and driver of each family of a library, in the table's words.
std::vector<std::string> SitesOf(const FormLibrary& library);
std::vector<std::string> DriversOf(const FormLibrary& library);
// Unit of the first coefficient of each family.
std::vector<std::string> UnitsOf(const FormLibrary& library);

// Everything of an effect but its statistics. kind_poses: the dataset has no marker readings.
DiscoveredEffect AnswerFor(const Effect& effect, const Dataset& dataset);

}  // namespace hexcal
