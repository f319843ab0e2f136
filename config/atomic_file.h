// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace hexcal {

// Writes the whole of content to path, or leaves what was there: a private temporary (mode 0600
// until it is whole, then 0666 less the umask) in the same folder, fsync, rename, fsync of the
// folder. OutputError says which step failed and why; the temporary is removed then.
void WriteFileAtomically(const std::string& path, std::string_view content);

// Makes the folder and its parents. OutputError if a file is in the way.
void MakeFolder(const std::string& path);

}  // namespace hexcal
