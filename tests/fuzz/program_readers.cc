// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <optional>

#include "apps/batch_manifest.h"
#include "apps/config_file.h"
#include "apps/usage_error.h"
#include "batch/chunk_files.h"
#include "batch/store.h"
#include "config/input_error.h"
#include "fuzz/readers.h"
#include "testing/batch_jobs.h"

namespace hexcal::fuzz {
namespace {

constexpr std::int64_t kTasks = 640;  // ten a chunk

// The settings of every command.
void ReadSettings(const std::string&, const std::string& path, const Reader&) {
  const gflags::FlagSaver flags_as_they_were;
  std::optional<InputError> refusal;
  bool is_taken = false;
  for (const Command& command : Commands()) {
    CommandLine line;
    line.command = &command;
    try {
      ApplyConfigFile(path, line);
      is_taken = true;
    } catch (const InputError& error) {
      CheckMessage(error.what());
      refusal = error;
    }
  }
  if (!is_taken) throw *refusal;
}

void ReadBatch(const std::string&, const std::string& path, const Reader&) {
  const gflags::FlagSaver flags_as_they_were;
  try {
    ReadManifest(path);
  } catch (const UsageError& error) {  // settings that do not go together
    CheckMessage(error.what());
  }
}

void ReadChunk(const std::string& folder, const std::string&, const Reader&) {
  const Batch batch = testing::ToyBatch(kTasks);
  const ChunkFiles files(folder, batch);
  for (const std::int64_t chunk : files.Present()) files.Read(chunk);
}

void ReadStore(const std::string&, const std::string& path, const Reader&) {
  const Batch batch = testing::ToyBatch(kTasks);
  Store store(path, batch, Database::Access::kRead);
  store.Missing({0, kTasks});
  store.Count(RowStatus::kFailed);
  store.Messages(RowStatus::kFailed, 10);
  store.ForEach([](const Row&) {});
}

}  // namespace

std::vector<Reader> ProgramReaders() {
  return {{"settings", "fuzzed.yaml", &ReadSettings},
          {"manifest", "fuzzed.yaml", &ReadBatch},
          {"chunk", "chunks/000001.csv", &ReadChunk},
          {"store", "fuzzed.db", &ReadStore}};
}

}  // namespace hexcal::fuzz
