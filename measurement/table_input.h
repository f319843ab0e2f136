// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "config/table.h"
#include "config/units.h"

namespace hexcal {

// What every part of a dataset is read with.
struct ReadContext {
  std::string path;  // of the YAML file
  Units units;
  std::vector<std::string>* warnings = nullptr;
};

// The table that a mapping gives under file: or rows: (exactly one of them). A path is relative to
// the dataset's folder and may not lead out of it, by symbolic links neither.
TableReader OpenTable(const MapReader& mapping, std::string_view what, const ReadContext& context);

// The path that a YAML file at context_path gives for another file of its folder, as OpenTable
// takes it. what: "a table"; folder: "the dataset's folder".
std::string PathBeside(const YamlNode& node,
                       const std::string& context_path,
                       std::string_view what,
                       std::string_view folder);

// Refuses a header that lacks a required column, or has one that is not known (naming the nearest
// known one). expected: the columns in words.
void CheckColumns(const TableReader& table,
                  const std::vector<std::string_view>& required,
                  const std::vector<std::string_view>& optional,
                  std::string_view expected);

// The cell's length in m. InputError beyond kLongestLength.
double ReadLength(const TableReader& table, int column, const Units& units);

}  // namespace hexcal
