// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "estimator/observations.h"
#include "report/export/calibration.h"

namespace hexcal {

// How other programs call the frames.
struct FrameNames {
  std::string world = "world", base = "base", platform = "platform", tool = "tool";
};

struct ExportInput {
  Calibration calibration;
  FrameNames frames;
  const Observations* observations = nullptr;  // of the dataset, for formats that need it
};

// As (name, content).
using ExportedFiles = std::vector<std::pair<std::string, std::string>>;

// A format that hexcal writes for other programs: help and docs/formats.md go by this table.
struct ExportFormat {
  std::string_view name;
  std::string_view summary;  // what it is, one line
  bool needs_dataset;
  std::vector<std::string_view> files;  // that it writes
  ExportedFiles (*write)(const ExportInput& input);
};

const std::vector<ExportFormat>& ExportFormats();
const ExportFormat* FindExportFormat(std::string_view name);  // nullptr if there is none

// What stands in the first line of those files that can have comments.
inline constexpr std::string_view kExportMark = "hexcal export";

}  // namespace hexcal
