// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_manifest.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/batch_datasets.h"
#include "apps/batch_study.h"
#include "apps/version.h"
#include "config/input_file.h"
#include "config/strict_yaml.h"
#include "report/digest.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/batch/1";
constexpr std::size_t kLongestName = 64;
constexpr std::int64_t kMostRows = 10'000'000;

// It stands in file names, SQL and CSV.
std::string ReadName(const YamlNode& node) {
  constexpr std::string_view kExpected =
      "a name of at most 64 letters, digits, '.', '-' and '_', the first a letter or digit";
  const std::string name = ReadText(node, kExpected);
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  const bool good = !name.empty() && name.size() <= kLongestName && is_letter(name[0]) &&
                    std::all_of(name.begin(), name.end(), [&](char c) {
                      return is_letter(c) || c == '.' || c == '-' || c == '_';
                    });
  if (!good) throw InputError(node.where, fmt::format("the name '{}'", name), kExpected);
  return name;
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

void RequireFormat(const YamlNode& node) {
  if (ReadText(node) != kFormat)
    throw InputError(node.where, fmt::format("the format '{}'", node.scalar), kFormat);
}

void RequireOnlyAStudy(const MapReader& reader) {
  for (const char* key : {"command", "datasets", "settings"})
    if (const YamlNode* other = reader.Optional(key))
      throw InputError(other->where,
                       fmt::format("{} beside a study", key),
                       "either datasets, or study and estimators");
}

}  // namespace

Manifest ReadManifest(const std::string& path) {
  const YamlNode root = ParseYamlFile(path);
  const MapReader reader(
      root,
      "the manifest",
      {"format", "name", "command", "datasets", "settings", "study", "estimators"});
  RequireFormat(reader.Required("format"));
  Manifest manifest;
  manifest.batch.name = ReadName(reader.Required("name"));
  // What the job adds to this: contents or names of other files.
  std::string identity = FirstLine(VersionText()) + "\n" + HashFiles({path})[0].sha256 + "\n";
  if (reader.Has("study") || reader.Has("estimators")) {
    RequireOnlyAStudy(reader);
    auto job = std::make_unique<StudyJob>(ReadStudy(path, manifest.batch.name, reader, &identity));
    manifest.study = job.get();
    manifest.batch.job = std::move(job);
  } else {
    manifest.batch.job = ReadDatasetsJob(path, reader, &identity);
  }
  manifest.batch.digest = Sha256(identity);
  if (manifest.batch.rows() > kMostRows)
    throw InputError(reader.where(),
                     fmt::format("{} rows of results", manifest.batch.rows()),
                     fmt::format("at most {}", kMostRows));
  return manifest;
}

}  // namespace hexcal
