// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/units_reader.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "measurement/labels.h"

namespace hexcal {

Units ReadUnits(const YamlNode& node) {
  const MapReader map(node, "units", {"length", "angle"});
  const auto read = [&](std::string_view key, auto find, const char* expected) {
    const YamlNode& value = map.Required(key);
    const std::optional<Unit> unit = find(ReadText(value, expected));
    if (unit) return unit->factor;
    throw InputError(
        value.where, fmt::format("the {} unit {}", key, Quoted(value.scalar)), expected);
  };
  return {read("length", FindLengthUnit, "m or mm"), read("angle", FindAngleUnit, "rad or deg")};
}

}  // namespace hexcal
