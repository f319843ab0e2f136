// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace hexcal {

// A file open for reading, of at most max_bytes. InputError("PATH: found ..., expected ...") where
// it is missing, a folder, unreadable or too large (found at opening for ordinary files, while
// reading for pipes).
class InputFile {
 public:
  InputFile(const std::string& path, std::int64_t max_bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  // Up to size bytes to where `to` points; 0 only at the end of the file.
  std::size_t Read(char* to, std::size_t size);

 private:
  std::string path_;
  std::int64_t max_bytes_;
  std::int64_t bytes_read_ = 0;
  int descriptor_;
};

// The whole file.
std::string ReadTextFile(const std::string& path, std::int64_t max_bytes);

}  // namespace hexcal
