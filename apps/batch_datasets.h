// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "batch/job.h"
#include "config/strict_yaml.h"

namespace hexcal {

// The job of a manifest with `datasets`: one task a dataset, done by calibrate or discover with the
// manifest's `settings`, which become this program's flags. Adds the files' names to identity.
std::unique_ptr<Job> ReadDatasetsJob(const std::string& manifest_path,
                                     const MapReader& manifest,
                                     std::string* identity);

}  // namespace hexcal
