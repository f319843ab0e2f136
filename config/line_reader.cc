// SPDX-License-Identifier: BSD-3-Clause
#include "config/line_reader.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "config/utf8.h"

namespace hexcal {
namespace {

constexpr std::size_t kChunk = 256 << 10;
constexpr std::size_t kLongestLine = 1 << 20;

// Anything but printable ASCII. One comparison a byte, which compilers turn into vector code.
bool HasUnusualByte(std::string_view text) {
  bool unusual = false;
  for (const char c : text) unusual |= static_cast<unsigned char>(c - 0x20) >= 0x60;
  return unusual;
}

}  // namespace

LineReader::LineReader(const std::string& path, std::int64_t max_bytes)
    : name_(std::make_shared<const std::string>(path)), file_(path, max_bytes) {}

Location LineReader::Where(int column) const {
  constexpr std::int64_t kLast = std::numeric_limits<int>::max();
  return {name_, static_cast<int>(std::min(number_, kLast)), column};
}

// Reads on behind what is not yet taken; false at the end of the file.
bool LineReader::Fill() {
  if (end_ - begin_ > kLongestLine) {
    ++number_;
    throw InputError(Where(), "a line longer than 1 MiB", "a line for each row");
  }
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (buffer_.size() < end_ + kChunk) buffer_.resize(end_ + kChunk);
  const std::size_t count = file_.Read(buffer_.data() + end_, buffer_.size() - end_);
  end_ += count;
  return count > 0;
}

void LineReader::TakeLine(std::size_t end) {
  line_ = std::string_view(buffer_).substr(begin_, end - begin_);
  begin_ = std::min(end + 1, end_);
  if (++number_ == 1 && line_.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    line_.remove_prefix(kByteOrderMark.size());
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  if (HasUnusualByte(line_)) RefuseBadText(line_, Where(1));
}

bool LineReader::Next() {
  std::size_t searched = begin_;
  while (true) {
    const void* found = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
    if (found) {
      TakeLine(static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data()));
      return true;
    }
    const std::size_t pending = end_ - begin_;
    if (!Fill()) break;
    searched = begin_ + pending;
  }
  if (begin_ == end_) return false;
  TakeLine(end_);  // the last line may lack its line end
  return true;
}

}  // namespace hexcal
