// SPDX-License-Identifier: BSD-3-Clause
#include "apps/trial_read.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "apps/interrupt.h"
#include "apps/message.h"
#include "config/atomic_file.h"
#include "config/input_error.h"
#include "measurement/dataset.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

class PrivateFolder {
 public:
  PrivateFolder() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    path_ = ((error ? fs::path("/tmp") : parent) / "hexcal-XXXXXX").string();
    if (mkdtemp(path_.data()) == nullptr)
      throw OutputError(fmt::format("{}: cannot make this folder: {}", path_, strerror(errno)));
  }
  ~PrivateFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  std::string PathOf(const std::string& name) const { return path_ + "/" + name; }

  // Messages name the file as it will be called, not where it lies now.
  std::string WithoutPath(std::string text) const {
    const std::string prefix = path_ + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
      text.erase(at, prefix.size());
    return text;
  }

 private:
  std::string path_;
};

}  // namespace

void TryReading(const std::vector<std::pair<std::string, std::string>>& files,
                bool needs_measurement,
                const std::string& out) {
  const WhileWriting no_interrupt;  // it would leave the private folder
  const PrivateFolder folder;
  for (const auto& [name, content] : files) WriteFileAtomically(folder.PathOf(name), content);
  try {
    const Dataset dataset = ReadDataset(folder.PathOf("dataset.yaml"), needs_measurement);
    for (const std::string& warning : dataset.warnings) PrintWarning(folder.WithoutPath(warning));
  } catch (const InputError& error) {
    throw InputError(fmt::format("the dataset for {} is refused, and not written: {}",
                                 out,
                                 folder.WithoutPath(error.what())));
  }
}

}  // namespace hexcal
