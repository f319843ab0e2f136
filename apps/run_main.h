// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hexcal {

// The whole program: the only place where exceptions end. Returns the exit status.
int RunMain(int argc, char** argv);

}  // namespace hexcal
