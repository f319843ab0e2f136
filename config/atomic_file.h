// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hexcal {

// Writes the whole of content to path, or leaves what was there: a private temporary (mode 0600
// until it is whole, then 0666 less the umask) in the same folder, fsync, rename, fsync of the
// folder. OutputError says which step failed and why; the temporary is removed then.
void WriteFileAtomically(const std::string& path, std::string_view content);

// The same for several (path, content): a full disk leaves all of them as they were, as none takes
// its place before the last one is on the disk. The first, which may name the others, takes its
// place last.
void WriteFilesAtomically(const std::vector<std::pair<std::string, std::string>>& files);

// The same for a file too large to hold: nothing of it is seen before Commit, and nothing is left
// without it.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Write(std::string_view content);
  void Finish();  // it is on the disk; nothing more is written
  void Commit();  // it takes its place

 private:
  std::string path_;
  std::string temporary_;
  int descriptor_ = -1;
  bool finished_ = false;
  bool renamed_ = false;
};

// Removes the temporaries that killed processes left in the folder. Only where nobody is writing.
void RemoveLeftTemporaries(const std::string& folder);

// Makes the folder and its parents. OutputError if a file is in the way.
void MakeFolder(const std::string& path);

}  // namespace hexcal
