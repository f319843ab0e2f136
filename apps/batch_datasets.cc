// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_datasets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "apps/batch_columns.h"
#include "apps/batch_files.h"
#include "apps/batch_settings.h"
#include "apps/calibrate_options.h"
#include "apps/discover.h"
#include "apps/estimate_mounts.h"
#include "apps/usage_error.h"
#include "config/input_error.h"

namespace hexcal {
namespace {

class DatasetsJob : public Job {
 public:
  DatasetsJob(std::string manifest_path, std::vector<std::string> files)
      : manifest_path_(std::move(manifest_path)), files_(std::move(files)) {}

  std::int64_t tasks() const override { return static_cast<std::int64_t>(files_.size()); }

  std::vector<Outcome> Work(std::int64_t task) const override {
    const std::string& file = files_[static_cast<std::size_t>(task)];
    Outcome outcome;
    try {
      Do(ReadDataset(FromManifest(manifest_path_, file), true), &outcome);
    } catch (const InputError& error) {
      outcome = {RowStatus::kFailed, SeenFromManifest(error.what()), {}};
    } catch (const UsageError& error) {
      outcome = {RowStatus::kFailed, error.what(), {}};
    } catch (const std::bad_alloc&) {
      throw;  // of the machine, not of the dataset
    } catch (const std::exception& error) {
      outcome = {RowStatus::kFailed, fmt::format("internal error: {}", error.what()), {}};
    }
    outcome.cells.insert(outcome.cells.begin(), file);
    return {outcome};
  }

 protected:
  virtual void Do(const Dataset& dataset, Outcome* outcome) const = 0;

 private:
  // Results must not depend on the folder in which hexcal runs.
  std::string SeenFromManifest(const std::string& message) const {
    const std::string folder = FromManifest(manifest_path_, "");
    return message.compare(0, folder.size(), folder) == 0 ? message.substr(folder.size()) : message;
  }

  std::string manifest_path_;
  std::vector<std::string> files_;
};

class CalibrateJob : public DatasetsJob {
 public:
  CalibrateJob(std::string manifest_path, std::vector<std::string> files, CalibrateOptions options)
      : DatasetsJob(std::move(manifest_path), std::move(files)), options_(std::move(options)) {}

  const std::vector<Column>& columns() const override { return CalibrationColumns(); }

 protected:
  void Do(const Dataset& dataset, Outcome* outcome) const override {
    const Estimate estimate = EstimateMounts(dataset, MakeObservations(dataset), options_);
    if (!estimate.IsTrustworthy()) {
      outcome->status = RowStatus::kUntrusted;
      outcome->message = WhyUntrusted(estimate);
    }
    outcome->cells = CalibrationCells(dataset, estimate);
  }

 private:
  CalibrateOptions options_;
};

class DiscoverJob : public DatasetsJob {
 public:
  DiscoverJob(std::string manifest_path, std::vector<std::string> files, DiscoverOptions options)
      : DatasetsJob(std::move(manifest_path), std::move(files)), options_(std::move(options)) {}

  const std::vector<Column>& columns() const override { return DiscoveryColumns(); }

 protected:
  void Do(const Dataset& dataset, Outcome* outcome) const override {
    const Discovery discovery = Discover(dataset, options_);
    if (!discovery.estimate.IsTrustworthy()) {
      outcome->status = RowStatus::kUntrusted;
      outcome->message = WhyUntrusted(discovery.estimate);
    }
    outcome->cells = DiscoveryCells(dataset, discovery);
  }

 private:
  DiscoverOptions options_;
};

bool IsDiscover(const MapReader& manifest) {
  const YamlNode* command = manifest.Optional("command");
  if (command == nullptr || ReadText(*command) == "calibrate") return false;
  if (command->scalar == "discover") return true;
  throw InputError(command->where, fmt::format("'{}'", command->scalar), "calibrate or discover");
}

}  // namespace

std::unique_ptr<Job> ReadDatasetsJob(const std::string& manifest_path,
                                     const MapReader& manifest,
                                     std::string* identity) {
  const bool discovers = IsDiscover(manifest);
  std::vector<std::string> files = ReadFileList(manifest_path, manifest.Required("datasets"));
  for (const std::string& file : files) *identity += file + "\n";
  ApplyBatchSettings(discovers ? "discover" : "calibrate", manifest.Optional("settings"));
  if (!discovers)
    return std::make_unique<CalibrateJob>(
        manifest_path, std::move(files), OptionsAt(manifest.Optional("settings")));
  DiscoverOptions options = DiscoverOptionsFromFlags();
  options.threads = 1;
  return std::make_unique<DiscoverJob>(manifest_path, std::move(files), options);
}

}  // namespace hexcal
