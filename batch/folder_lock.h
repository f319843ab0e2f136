// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace hexcal {

// While one stands, no other process has the same folder for itself: a file in it that is locked
// as long as this process lives, however it ends, and removed by the last that had it alone.
class FolderLock {
 public:
  enum class Kind { kShared, kAlone };
  // Waits: shared, until nobody has it alone. kAlone: for nobody; then IsHeld() is false.
  // OutputError where the lock cannot be made.
  FolderLock(const std::string& folder, Kind kind);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool IsHeld() const { return descriptor_ >= 0; }

 private:
  bool Try(Kind kind);

  std::string path_;
  Kind kind_;
  int descriptor_ = -1;
};

}  // namespace hexcal
