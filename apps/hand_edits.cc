// SPDX-License-Identifier: BSD-3-Clause
#include "apps/hand_edits.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "config/input_error.h"
#include "report/digest.h"

namespace hexcal {
namespace {

constexpr std::string_view kSignature = "# As hexcal wrote it, with ";
constexpr std::string_view kDigest = ": sha256 ";
constexpr std::string_view kNoTables = "no tables";

// Lengths keep a line from moving from one file to the next.
std::string DigestOf(const std::vector<std::string>& contents) {
  std::string all;
  for (const std::string& content : contents) all += fmt::format("{}\n{}", content.size(), content);
  return Sha256(all);
}

// The tables' names, ", " between them.
std::string Signature(const std::string& tables, const std::vector<std::string>& contents) {
  return fmt::format("{}{}{}{}\n", kSignature, tables, kDigest, DigestOf(contents));
}

// Empty where it cannot be read: then it is not as it was written.
std::string ContentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool IsUnchanged(const OutputFolder& folder, const std::string& name) {
  std::string text = ContentOf(folder.PathOf(name));
  const std::size_t begin = text.find('\n') + 1, end = text.find('\n', begin) + 1;
  if (begin == 0 || end == 0) return false;
  const std::string line = text.substr(begin, end - begin);
  const std::size_t digest = line.find(kDigest);
  if (line.rfind(kSignature, 0) != 0 || digest == std::string::npos) return false;
  const std::string tables = line.substr(kSignature.size(), digest - kSignature.size());
  if (tables.find('/') != std::string::npos) return false;  // of this folder alone
  text.erase(begin, end - begin);
  std::vector<std::string> contents = {text};
  for (std::size_t at = 0; tables != kNoTables && at < tables.size();) {
    const std::size_t comma = std::min(tables.find(", ", at), tables.size());
    contents.push_back(ContentOf(folder.PathOf(tables.substr(at, comma - at))));
    at = comma + 2;
  }
  return line == Signature(tables, contents);
}

}  // namespace

void SignFiles(std::vector<std::pair<std::string, std::string>>& files,
               const std::string& dataset) {
  std::string* text = nullptr;
  std::string tables;
  std::vector<std::string> contents(1);
  for (auto& [name, content] : files) {
    if (name == dataset) {
      text = &content;
      contents.front() = content;
      continue;
    }
    tables += (tables.empty() ? "" : ", ") + name;
    contents.push_back(content);
  }
  CHECK_NOTNULL(text)->insert(
      text->find('\n') + 1, Signature(tables.empty() ? std::string(kNoTables) : tables, contents));
}

void RequireUnchanged(const OutputFolder& folder, const std::string& dataset) {
  const std::string path = folder.PathOf(dataset);
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored) || IsUnchanged(folder, dataset)) return;
  throw OutputError(fmt::format(
      "{}: this file or a table of it was changed since hexcal wrote it (--force replaces it)",
      path));
}

}  // namespace hexcal
