// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "apps/command.h"

namespace hexcal {

// A kind of file that hexcal reads or writes.
struct SchemaInfo {
  std::string_view name;
  std::string_view summary;
  std::string_view (*text)();  // null: follows from a table alone
};

const std::vector<SchemaInfo>& Schemas();
const SchemaInfo* FindSchema(std::string_view name);  // nullptr if there is none

// The JSON Schema (draft 2020-12), whole: every reference is to a definition in it. command: of
// settings, whose they are; nullptr for all.
nlohmann::ordered_json WholeSchema(const SchemaInfo& info, const Command* command);

}  // namespace hexcal
