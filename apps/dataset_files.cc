// SPDX-License-Identifier: BSD-3-Clause
#include "apps/dataset_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/message.h"
#include "config/input_error.h"

namespace hexcal {
namespace {

constexpr std::size_t kMaxWarnings = 10;

// Who names the folder means the dataset in it.
void RefuseFolder(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return;
  const std::filesystem::path inside = std::filesystem::path(path) / "dataset.yaml";
  if (std::filesystem::exists(inside, ignored))
    throw InputError(FileLocation(path),
                     "no file but a folder",
                     fmt::format("a dataset file (did you mean '{}'?)", inside.string()));
}

}  // namespace

Dataset OpenDataset(const std::string& path, bool needs_measurement) {
  RefuseFolder(path);
  Dataset dataset = ReadDataset(path, needs_measurement);
  for (const std::string& warning : dataset.warnings) PrintWarning(warning);
  return dataset;
}

void PrintNewWarnings(const Dataset& dataset,
                      const std::vector<std::string>& warnings,
                      const std::string& file) {
  std::size_t count = 0;
  for (const std::string& warning : warnings) {
    if (std::count(dataset.warnings.begin(), dataset.warnings.end(), warning) > 0) continue;
    if (++count <= kMaxWarnings) PrintWarning(dataset.name + ": " + warning);
  }
  if (count > kMaxWarnings)
    PrintWarning(
        fmt::format("{}: {} more warnings, in {}", dataset.name, count - kMaxWarnings, file));
}

std::vector<std::string> InputFiles(const Dataset& dataset, const std::string& model) {
  std::vector<std::string> files = {dataset.path};
  // A table may stand in the dataset itself.
  const auto add = [&files](const Location& where) {
    if (where.file && std::find(files.begin(), files.end(), *where.file) == files.end())
      files.push_back(*where.file);
  };
  add(dataset.robot_poses.where);
  if (dataset.measurement) add(dataset.measurement->where);
  if (!model.empty()) files.push_back(model);
  return files;
}

}  // namespace hexcal
