// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "config/number.h"
#include "config/strict_yaml.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal::testing {

using Json = nlohmann::ordered_json;

// Documents to be judged by schemas, all at once (validate.py, by Debian's python3-jsonschema).
class SchemaCheck {
 public:
  void AddSchema(const std::string& name, const Json& schema) { work_["schemas"][name] = schema; }
  void Add(const std::string& schema, const Json& document) {
    work_["cases"].push_back({{"schema", schema}, {"document", document}});
  }

  // A line for each document, in their order: empty where it is valid, else where and why not.
  std::vector<std::string> Judge() const {
    const TemporaryFolder folder;
    const ProgramResult result =
        RunProgram(HEXCAL_PYTHON, {{HEXCAL_VALIDATE, folder.Write("work.json", work_.dump())}});
    EXPECT_EQ(result.status, 0) << result.err << "(is python3-jsonschema installed?)";
    std::istringstream text(result.out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    EXPECT_EQ(lines.size(), work_["cases"].size());
    lines.resize(work_["cases"].size(), "not judged");
    return lines;
  }

 private:
  Json work_ = {{"schemas", Json::object()}, {"cases", Json::array()}};
};

// YAML as hexcal reads it: what stands in quotes is text.
inline Json JsonOf(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return {};
    case YamlNode::Kind::kSequence: {
      Json list = Json::array();
      for (const YamlNode& item : node.items) list.push_back(JsonOf(item));
      return list;
    }
    case YamlNode::Kind::kMap: {
      Json object = Json::object();
      for (const auto& [key, value] : node.entries) object[key.scalar] = JsonOf(value);
      return object;
    }
    case YamlNode::Kind::kScalar:
      break;
  }
  if (node.quoted) return node.scalar;
  if (node.scalar == "true" || node.scalar == "false") return node.scalar == "true";
  if (const std::optional<long> integer = ParseInteger(node.scalar)) return *integer;
  if (const std::optional<double> number = ParseDouble(node.scalar)) return *number;
  return node.scalar;
}

}  // namespace hexcal::testing
