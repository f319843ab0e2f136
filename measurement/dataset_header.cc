// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/dataset_header.h"

#include <fmt/format.h>

#include "measurement/labels.h"

namespace hexcal {

bool IsFolderName(std::string_view name) {
  const bool has_only_allowed =
      name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-") ==
      std::string_view::npos;
  return has_only_allowed && !name.empty() && name != "." && name != "..";
}

void CheckFormat(const YamlNode& root, std::string_view expected) {
  if (root.kind != YamlNode::Kind::kMap) return;  // MapReader says it better
  for (const auto& [key, value] : root.entries) {
    if (key.scalar != "format") continue;
    const std::string format = ReadText(value, expected);
    if (format == expected) return;
    throw InputError(value.where,
                     fmt::format("the format {}", Quoted(format)),
                     fmt::format("{}, which this version of hexcal reads", expected));
  }
  throw InputError(root.where, "no key 'format'", fmt::format("'format: {}'", expected));
}

std::string ReadName(const YamlNode& node) {
  const std::string name = ReadText(node, "a name");
  if (IsFolderName(name)) return name;
  throw InputError(
      node.where,
      fmt::format("the name {}", Quoted(name)),
      "letters, digits, '.', '_' and '-' only (it becomes the name of a folder of results)");
}

}  // namespace hexcal
