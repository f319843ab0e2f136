// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/hexapod_file.h"

#include <fmt/format.h>

#include "config/strict_yaml.h"
#include "measurement/units_reader.h"

namespace hexcal {
namespace {

const YamlNode& Required(const YamlNode& root, std::string_view key) {
  for (const auto& [name, value] : root.entries)
    if (name.scalar == key) return value;
  throw InputError(
      root.where, fmt::format("no key '{}'", key), "'units' and 'hexapod' as in a dataset");
}

}  // namespace

HexapodGeometry ReadHexapodFile(const std::string& path) {
  const YamlNode root = ParseYamlFile(path);
  const Units units = ReadUnits(Required(root, "units"));
  return ReadHexapodGeometry(Required(root, "hexapod"), units);
}

}  // namespace hexcal
