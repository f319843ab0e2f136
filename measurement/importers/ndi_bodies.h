// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// NDI's marker description file, text: "Marker Description File", "Real 3D", the number of markers,
// a table of them, mm. Views, normals and limits are not used.
StatedShape ReadRig(const std::string& path);

// NDI's tool definition as a Polaris holds it, binary: "NDI", a checksum of all bytes from the
// seventh on, the number of markers, their places, mm. Faces and limits are not used.
StatedShape ReadRom(const std::string& path);

}  // namespace hexcal
