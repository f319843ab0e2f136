// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hexcal {

// The commit that was built, "0123456789ab", "0123456789ab with changes" where files were changed
// since; "unknown" of a build without git.
std::string RevisionText();

// "hexcal 0.1.0", "revision 0123456789ab" and the libraries it was built with, a line each.
std::string VersionText();

}  // namespace hexcal
