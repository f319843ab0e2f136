// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/command.h"

namespace hexcal {

// hexcal man
Command ManCommand();

// hexcal(1) as man reads it, from the tables of commands and flags.
std::string ManPage();

}  // namespace hexcal
