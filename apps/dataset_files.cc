// SPDX-License-Identifier: BSD-3-Clause
#include "apps/dataset_files.h"

#include <fmt/format.h>

#include "apps/message.h"

namespace hexcal {

Dataset OpenDataset(const std::string& path, bool needs_measurement) {
  Dataset dataset = ReadDataset(path, needs_measurement);
  for (const std::string& warning : dataset.warnings) PrintWarning(warning);
  return dataset;
}

std::vector<std::string> InputFiles(const Dataset& dataset, const std::string& model) {
  std::vector<std::string> files = {dataset.path};
  if (dataset.robot_poses.where.file) files.push_back(*dataset.robot_poses.where.file);
  if (dataset.measurement && dataset.measurement->where.file)
    files.push_back(*dataset.measurement->where.file);
  if (!model.empty()) files.push_back(model);
  return files;
}

}  // namespace hexcal
