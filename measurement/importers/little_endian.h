// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>

namespace hexcal {

// Numbers of a binary file, least significant byte first. at + its size must be inside bytes.
inline std::uint16_t Uint16At(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[at]) |
                                    static_cast<unsigned char>(bytes[at + 1]) << 8);
}

inline std::uint32_t Uint32At(std::string_view bytes, std::size_t at) {
  return Uint16At(bytes, at) | static_cast<std::uint32_t>(Uint16At(bytes, at + 2)) << 16;
}

inline float FloatAt(std::string_view bytes, std::size_t at) {
  const std::uint32_t bits = Uint32At(bytes, at);
  float value;
  static_assert(sizeof value == sizeof bits, "IEEE 754");
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace hexcal
