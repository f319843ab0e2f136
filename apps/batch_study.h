// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch/study.h"
#include "config/strict_yaml.h"

namespace hexcal {

// The study of a manifest: `study` and `estimators`. Adds the digests of the files that it names to
// identity. InputError with file and line.
Study ReadStudy(const std::string& manifest_path,
                const std::string& name,
                const MapReader& manifest,
                std::string* identity);

}  // namespace hexcal
