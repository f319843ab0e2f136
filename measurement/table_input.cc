// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/table_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_set>

#include "config/nearest_word.h"
#include "measurement/checked_values.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

bool StartsWith(const fs::path& path, const fs::path& folder) {
  const auto [folder_end, unused] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return folder_end == folder.end();
}

}  // namespace

std::string PathBeside(const YamlNode& node,
                       const std::string& context_path,
                       std::string_view what,
                       std::string_view folder_name) {
  const std::string text = ReadText(node, fmt::format("the path of {}", what));
  const std::string inside =
      fmt::format("the path of {} in the folder of this file, relative to it", what);
  const auto refuse = [&](std::string_view problem) {
    throw InputError(
        node.where, fmt::format("the path {}, which {}", Quoted(text), problem), inside);
  };
  const fs::path relative(text);
  if (text.empty()) throw InputError(node.where, "an empty path", inside);
  if (relative.is_absolute()) refuse("is absolute");
  if (*relative.lexically_normal().begin() == "..") refuse(fmt::format("leaves {}", folder_name));

  const fs::path folder = fs::path(context_path).parent_path();
  const fs::path path = folder / relative;
  std::error_code error;
  const fs::path real_path = fs::canonical(path, error);
  if (error)
    throw InputError(node.where,
                     fmt::format("no file {}", Quoted(text)),
                     fmt::format("an existing {} (its path is relative to this file)",
                                 what.substr(what.find(' ') + 1)));
  if (!StartsWith(real_path, fs::canonical(folder.empty() ? "." : folder)))
    refuse(fmt::format("leaves {} by a symbolic link", folder_name));
  if (!fs::is_regular_file(real_path, error)) refuse("is not a file");
  return path.string();
}

TableReader OpenTable(const MapReader& mapping, std::string_view what, const ReadContext& context) {
  const YamlNode* file = mapping.Optional("file");
  const YamlNode* rows = mapping.Optional("rows");
  constexpr const char* kOneOfThem = "one of them";
  if (file == nullptr && rows == nullptr)
    throw InputError(
        mapping.where(), fmt::format("neither file: nor rows: in {}", what), kOneOfThem);
  if (file != nullptr && rows != nullptr)
    throw InputError(rows->where, fmt::format("both file: and rows: in {}", what), kOneOfThem);
  return file != nullptr ? TableReader::FromFile(
                               PathBeside(*file, context.path, "a table", "the dataset's folder"))
                         : TableReader::FromRows(*rows);
}

void CheckColumns(const TableReader& table,
                  const std::vector<std::string_view>& required,
                  const std::vector<std::string_view>& optional,
                  std::string_view expected) {
  std::vector<std::string_view> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  const std::unordered_set<std::string_view> known_set(known.begin(), known.end());
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < table.header().size(); ++i) {
    const std::string& column = table.header()[i];
    const Location where = table.HeaderLocation(static_cast<int>(i));
    seen.insert(column);
    if (known_set.count(column) > 0) continue;
    throw InputError(where,
                     fmt::format("the unknown column {}", Quoted(column)),
                     fmt::format("{}{}", expected, DidYouMean(column, known)));
  }
  for (const std::string_view column : required)
    if (seen.count(column) == 0)
      throw InputError(table.HeaderLocation(0), fmt::format("no column '{}'", column), expected);
}

double ReadLength(const TableReader& table, int column, const Units& units) {
  const double length = units.length * table.Number(column);
  if (std::abs(length) <= kLongestLength) return length;
  throw InputError(table.CellLocation(column),
                   fmt::format("{} in column '{}'",
                               Quoted(table.Text(column)),
                               table.header()[static_cast<std::size_t>(column)]),
                   "a length of at most 1000 km (what was not seen is left out)");
}

}  // namespace hexcal
