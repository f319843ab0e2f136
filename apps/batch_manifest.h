// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch/job.h"
#include "batch/study_job.h"

namespace hexcal {

// What a manifest (docs/batch.md) says is to be done.
struct Manifest {
  Batch batch;
  const StudyJob* study = nullptr;  // the batch's job, if that is a study
};

// Sets the flags of the command that the manifest's settings name. InputError with file and line
// for whatever docs/batch.md calls bad, before anything is computed.
Manifest ReadManifest(const std::string& path);

}  // namespace hexcal
