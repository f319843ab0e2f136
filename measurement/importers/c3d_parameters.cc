// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/c3d_parameters.h"

#include <fmt/format.h>

#include <cstdlib>

#include "measurement/importers/little_endian.h"

namespace hexcal {
namespace {

constexpr int kIntel = 84;
constexpr std::size_t kMostParameters = 4096;

std::string Capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

// Walks through the records of the section; never reads behind end.
class SectionReader {
 public:
  SectionReader(std::string_view bytes, std::size_t begin, std::size_t end, const Location& file)
      : bytes_(bytes), at_(begin), end_(end), file_(file) {}

  C3dParameters Read() {
    while (ReadRecord()) {
    }
    C3dParameters named;
    for (auto& [key, parameter] : parameters_) {
      const auto group = groups_.find(key.first);
      if (group != groups_.end()) named[group->second + ":" + key.second] = std::move(parameter);
    }
    return named;
  }

 private:
  std::size_t Take(std::size_t size) {
    if (size > end_ - at_)
      RefuseC3d(file_, at_, "a parameter that leaves its section", "a whole section");
    at_ += size;
    return at_ - size;
  }
  int TakeSigned() { return static_cast<signed char>(bytes_[Take(1)]); }
  std::size_t TakeByte() { return static_cast<unsigned char>(bytes_[Take(1)]); }

  // False behind the last.
  bool ReadRecord() {
    if (end_ - at_ < 2) return false;
    const int name_size = TakeSigned();  // below 0: locked
    const int id = TakeSigned();         // of a group below 0
    if (name_size == 0 || id == 0) return false;
    const std::string name =
        Capitals(bytes_.substr(Take(static_cast<std::size_t>(std::abs(name_size))),
                               static_cast<std::size_t>(std::abs(name_size))));
    const std::size_t offset_at = Take(2);
    const std::size_t offset = Uint16At(bytes_, offset_at);
    if (id < 0)
      groups_[-id] = name;
    else
      ReadParameter(id, name);
    if (offset == 0) return false;
    const std::size_t next = offset_at + offset;
    if (next < at_ || next > end_)
      RefuseC3d(file_,
                offset_at,
                fmt::format("{} bytes to the next parameter", offset),
                "a parameter behind this one, in the section");
    at_ = next;
    return true;
  }

  void ReadParameter(int id, const std::string& name) {
    C3dParameter parameter;
    parameter.type = TakeSigned();
    std::size_t size = static_cast<std::size_t>(std::abs(parameter.type));
    const std::size_t dimensions = TakeByte();
    if (size == 0 || size > 4 || size == 3 || dimensions > 7)
      RefuseC3d(file_,
                at_,
                fmt::format("type {} with {} dimensions", parameter.type, dimensions),
                "type -1, 1, 2 or 4 with at most 7");
    for (std::size_t i = 0; i < dimensions; ++i) {
      parameter.dimensions.push_back(TakeByte());
      size *= parameter.dimensions.back();
      if (size > end_)
        RefuseC3d(file_, at_, "a parameter larger than the section", "a smaller one");
    }
    parameter.data = bytes_.substr(Take(size), size);
    if (parameters_.size() >= kMostParameters)
      RefuseC3d(file_, at_, "more parameters", fmt::format("at most {}", kMostParameters));
    parameters_[{id, name}] = std::move(parameter);
  }

  std::string_view bytes_;
  std::size_t at_, end_;
  const Location& file_;
  std::map<int, std::string> groups_;
  std::map<std::pair<int, std::string>, C3dParameter> parameters_;
};

}  // namespace

void RefuseC3d(const Location& file,
               std::size_t byte,
               std::string_view found,
               std::string_view expected) {
  throw InputError(file, fmt::format("at byte {}: {}", byte, found), expected);
}

C3dParameters ReadC3dParameters(std::string_view bytes, std::size_t block, const Location& file) {
  const std::size_t begin = (block - 1) * kC3dBlock;
  if (block < 2 || begin + 4 > bytes.size())
    RefuseC3d(file, 0, fmt::format("parameters in block {}", block), "a block of the file");
  const int processor = static_cast<unsigned char>(bytes[begin + 3]);
  if (processor != kIntel)
    RefuseC3d(file,
              begin + 3,
              processor == kIntel + 1   ? std::string("numbers of a DEC processor (85)")
              : processor == kIntel + 2 ? std::string("numbers of an SGI processor (86)")
                                        : fmt::format("processor {}", processor),
              "those of an Intel one (84): save the file so");
  const std::size_t blocks = static_cast<unsigned char>(bytes[begin + 2]);
  const std::size_t end = begin + blocks * kC3dBlock;
  if (blocks == 0 || end > bytes.size())
    RefuseC3d(file,
              begin + 2,
              fmt::format("{} blocks of parameters", blocks),
              "as many as the file has: is it cut off?");
  return SectionReader(bytes, begin + 4, end, file).Read();
}

std::optional<std::size_t> C3dCount(const C3dParameter& parameter) {
  if (parameter.type == 2 && parameter.data.size() >= 2) return Uint16At(parameter.data, 0);
  if (parameter.type != 4 || parameter.data.size() < 4) return std::nullopt;
  const float count = FloatAt(parameter.data, 0);
  if (!(count >= 0.0f) || !(count < 1e9f)) return std::nullopt;
  return static_cast<std::size_t>(count);
}

std::vector<std::string> C3dTexts(const C3dParameter& parameter) {
  std::vector<std::string> texts;
  if (parameter.type != -1 || parameter.dimensions.empty() || parameter.dimensions[0] == 0)
    return texts;
  const std::size_t size = parameter.dimensions[0];
  for (std::size_t at = 0; at + size <= parameter.data.size(); at += size) {
    const std::string_view text = parameter.data.substr(at, size);
    texts.emplace_back(text.substr(0, text.find_last_not_of(std::string_view(" \0", 2)) + 1));
  }
  return texts;
}

}  // namespace hexcal
