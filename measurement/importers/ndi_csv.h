// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// The wide CSV of NDI's Polaris sample program and of NDI Track: a row a frame, a block of columns
// a tool, which begins with its port; its pose (tracker from tool, mm, quaternion scalar first)
// and its markers, each with a state. Whatever is not OK counts as unseen, and so do all markers of
// a tool that is not: they look valid and are not.
Recording ReadNdiCsv(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
