// SPDX-License-Identifier: BSD-3-Clause
#include "apps/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>

#include "apps/interrupt.h"
#include "apps/message.h"
#include "config/atomic_file.h"
#include "config/input_error.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFirstBytes = 256;

// Empty if the file cannot be read: then it is not known to be hexcal's.
std::string FirstBytes(const std::string& path) {
  std::string bytes(kFirstBytes, '\0');
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return "";
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file));
  std::fclose(file);
  return bytes;
}

bool Exists(const std::string& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() != fs::file_type::not_found;
}

bool HasMark(const std::string& path, const std::string& mark) {
  std::error_code ignored;
  return !mark.empty() && fs::is_regular_file(path, ignored) &&
         FirstBytes(path).find(mark) != std::string::npos;
}

// Which command wrote a page that has the mark; empty where it does not say.
std::string WriterOf(const std::string& path, const std::string& mark) {
  const std::string bytes = FirstBytes(path);
  const std::size_t at = bytes.find(mark);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + mark.size();
  const std::size_t end = bytes.find_first_not_of("abcdefghijklmnopqrstuvwxyz", begin);
  return end == std::string::npos || bytes[end] != '/' ? "" : bytes.substr(begin, end - begin);
}

std::string ContentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw OutputError(fmt::format("{}: cannot be read, to be kept", path));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void RefuseInput(const std::string& path, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    std::error_code not_both_there;
    if (fs::equivalent(path, input, not_both_there) && !not_both_there)
      throw OutputError(fmt::format("{}: would replace an input of this run ({})", path, input));
  }
}

// The folder itself, or the nearest one above it that is there already, takes new files.
void RequireWritable(const std::string& folder) {
  fs::path existing = fs::absolute(folder);
  while (!Exists(existing.string()) && existing.has_relative_path())
    existing = existing.parent_path();
  std::error_code ignored;
  if (!fs::is_directory(existing, ignored))
    throw OutputError(
        fmt::format("{}: cannot make this folder: {} is a file", folder, existing.string()));
  if (access(existing.c_str(), W_OK | X_OK) != 0)
    throw OutputError(fmt::format("{}: cannot write here: {}", folder, std::strerror(errno)));
}

}  // namespace

OutputFolder::OutputFolder(const std::string& out,
                           const std::string& dataset_name,
                           const std::vector<OutputFile>& files,
                           const std::vector<std::string>& inputs,
                           bool force)
    : path_(dataset_name.empty() ? out : (fs::path(out) / dataset_name).string()), inputs_(inputs) {
  RequireWritable(path_);
  const bool first_is_ours = HasMark(PathOf(files.front().name), files.front().mark);
  for (const OutputFile& file : files) {
    const bool is_ours = file.mark.empty() ? first_is_ours : HasMark(PathOf(file.name), file.mark);
    CheckFile(file, is_ours, force);
    if (is_ours && !file.command.empty()) KeepOther(file, force);
  }
}

void OutputFolder::CheckFile(const OutputFile& file, bool is_ours, bool force) {
  const std::string path = PathOf(file.name);
  if (!Exists(path)) return;
  RefuseInput(path, inputs_);
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    throw OutputError(fmt::format("{}: a folder is in the way", path));
  if (!is_ours && !force)
    throw OutputError(fmt::format(
        "{}: this file is in the way, and not one of hexcal's (--force replaces it)", path));
}

void OutputFolder::KeepOther(const OutputFile& page, bool force) {
  const std::string writer = WriterOf(PathOf(page.name), page.mark);
  if (writer.empty() || writer == page.command) return;
  const OutputFile kept = {fmt::format("report-{}.html", writer), page.mark + writer + "/"};
  CheckFile(kept, HasMark(PathOf(kept.name), kept.mark), force);
  kept_.push_back({page.name, kept.name, writer});
}

void OutputFolder::Write(const std::vector<std::pair<std::string, std::string>>& files) {
  std::vector<std::pair<std::string, std::string>> by_path;
  for (const auto& [name, content] : files) by_path.emplace_back(PathOf(name), content);
  // Behind the others, since the last takes its place first.
  for (const KeptPage& page : kept_)
    by_path.emplace_back(PathOf(page.kept_as), ContentOf(PathOf(page.name)));
  {
    const WhileWriting no_interrupt;
    MakeFolder(path_);
    WriteFilesAtomically(by_path);
  }
  for (const KeptPage& page : kept_)
    PrintWarning(fmt::format("{} was of 'hexcal {}', whose page is now {}",
                             PathOf(page.name),
                             page.command,
                             PathOf(page.kept_as)));
  kept_.clear();
}

std::string OutputFolder::PathOf(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

std::vector<std::string> OutputFolder::PathsOf(
    const std::vector<std::pair<std::string, std::string>>& files) const {
  std::vector<std::string> paths;
  for (const auto& [name, content] : files) paths.push_back(PathOf(name));
  return paths;
}

void RequireDistinctNames(const std::vector<std::pair<std::string, std::string>>& datasets) {
  std::map<std::string, std::string> file_of_name;
  for (const auto& [file, name] : datasets) {
    const auto [other, is_new] = file_of_name.emplace(name, file);
    if (!is_new)
      throw InputError(FileLocation(file),
                       fmt::format("the name '{}', which {} has too", name, other->second),
                       "a name of its own: it becomes the folder of the results");
  }
}

}  // namespace hexcal
