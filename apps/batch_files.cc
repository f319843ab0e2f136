// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_files.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace hexcal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 1'000'000;

bool IsPattern(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }

// As a pattern that matches itself alone.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// Sorted by bytes, whatever the locale; relative to folder.
std::vector<std::string> Matches(const std::string& folder, const YamlNode& pattern) {
  const bool is_absolute = fs::path(pattern.scalar).is_absolute();
  const std::string start = folder.empty() || is_absolute ? "" : folder + "/";
  glob_t found = {};
  const int status =
      glob((Escaped(start) + pattern.scalar).c_str(), GLOB_NOSORT | GLOB_ERR, nullptr, &found);
  std::vector<std::string> matches;
  for (std::size_t i = 0; status == 0 && i < found.gl_pathc; ++i)
    matches.push_back(std::string(found.gl_pathv[i]).substr(start.size()));
  globfree(&found);
  if (matches.empty())
    throw InputError(pattern.where,
                     fmt::format("no file like '{}'", pattern.scalar),
                     "a pattern for files that are there and can be read");
  std::sort(matches.begin(), matches.end());
  return matches;
}

}  // namespace

std::string FromManifest(const std::string& manifest_path, const std::string& path) {
  return (fs::path(manifest_path).parent_path() / path).string();
}

std::vector<std::string> ReadFileList(const std::string& manifest_path, const YamlNode& list) {
  constexpr std::string_view kExpected = "a list of files, or of patterns for them";
  const std::string folder = fs::path(manifest_path).parent_path().string();
  std::vector<std::string> files;
  std::map<std::string, Location> seen;
  for (const YamlNode& item : ReadSequence(list, kExpected)) {
    const std::string text = ReadText(item, "a file, or a pattern for files");
    const std::vector<std::string> some =
        IsPattern(text) ? Matches(folder, item) : std::vector<std::string>{text};
    for (const std::string& file : some) {
      const auto [first, is_new] =
          seen.emplace(fs::path(file).lexically_normal().string(), item.where);
      if (!is_new)
        throw InputError(
            item.where,
            fmt::format("{} again (it is named at {})", file, first->second.ToString()),
            "each dataset once");
      files.push_back(file);
    }
  }
  if (files.empty() || files.size() > kMostFiles)
    throw InputError(list.where, fmt::format("{} datasets", files.size()), "1 to a million");
  return files;
}

}  // namespace hexcal
