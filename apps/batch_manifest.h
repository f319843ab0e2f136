// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch/job.h"

namespace hexcal {

// What a manifest (docs/batch.md) says is to be done.
struct Manifest {
  Batch batch;
  bool is_study = false;
};

// Sets the flags of the command that the manifest's settings name. InputError with file and line
// for whatever docs/batch.md calls bad, before anything is computed.
Manifest ReadManifest(const std::string& path);

}  // namespace hexcal
