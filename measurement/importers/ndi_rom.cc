// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "config/input_file.h"
#include "measurement/importers/little_endian.h"
#include "measurement/importers/ndi_bodies.h"

namespace hexcal {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr std::size_t kSize = 752;
constexpr std::size_t kChecksumAt = 4, kCheckedFrom = 6, kCountAt = 0x1C, kMarkersAt = 0x48;
constexpr std::size_t kMarkerSize = 12;
constexpr std::uint32_t kMostMarkers = 20;  // up to the normals of the faces, at 0x138
constexpr float kFurthest = 1e4f;           // mm

}  // namespace

StatedShape ReadRom(const std::string& path) {
  const Location file = FileLocation(path);
  const std::string bytes = ReadTextFile(path, 1 << 20);
  if (bytes.substr(0, 4) != std::string("NDI\0", 4))
    throw InputError(file, "no 'NDI' at its beginning", "an NDI tool definition (.rom)");
  if (bytes.size() != kSize)
    throw InputError(file,
                     fmt::format("{} bytes", bytes.size()),
                     fmt::format("{}, a whole tool definition (.rom)", kSize));
  std::uint32_t sum = 0;
  for (std::size_t i = kCheckedFrom; i < bytes.size(); ++i)
    sum += static_cast<unsigned char>(bytes[i]);
  const std::uint16_t stated = Uint16At(bytes, kChecksumAt);
  if ((sum & 0xFFFF) != stated)
    throw InputError(file,
                     fmt::format("a checksum of {:#06x}", stated),
                     fmt::format("{:#06x}, that of its bytes: it is damaged", sum & 0xFFFF));
  const std::uint32_t count = Uint32At(bytes, kCountAt);
  if (count < 3 || count > kMostMarkers)
    throw InputError(file, fmt::format("{} markers", count), fmt::format("3 to {}", kMostMarkers));
  StatedShape shape{path, {}, Eigen::Matrix3Xd(3, count)};
  for (std::uint32_t m = 0; m < count; ++m) {
    shape.names.push_back(std::to_string(m + 1));
    for (std::size_t k = 0; k < 3; ++k) {
      const float value = FloatAt(bytes, kMarkersAt + kMarkerSize * m + 4 * k);
      if (!(std::abs(value) <= kFurthest))
        throw InputError(
            file, fmt::format("{} as a coordinate of marker {}", value, m + 1), "one within 10 m");
      shape.points(static_cast<Eigen::Index>(k), m) = kMillimetre * static_cast<double>(value);
    }
  }
  return shape;
}

}  // namespace hexcal
