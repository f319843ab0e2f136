// SPDX-License-Identifier: BSD-3-Clause
// The YAML that docs/ shows is YAML that hexcal takes: each block is parsed as hexcal does and
// judged by the schema that its "format:" names; a part of a file by that of its page.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "apps/schemas.h"
#include "config/input_error.h"
#include "testing/json_schema.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;
using ::hexcal::testing::Json;
using ::hexcal::testing::JsonOf;
using ::hexcal::testing::SchemaCheck;

// What a page shows parts of.
const std::map<std::string, std::string> kPages = {
    {"dataset.md", "dataset"}, {"model.md", "model"}, {"commands.md", "settings"}};

struct Block {
  std::string where;  // page:line
  std::string page;
  std::string text;
};

std::vector<Block> YamlBlocks() {
  std::vector<Block> blocks;
  for (const auto& entry : fs::directory_iterator(HEXCAL_SOURCE "/docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string page = entry.path().filename().string();
    std::ifstream file(entry.path());
    bool is_yaml = false;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
      ++number;
      if (line.rfind("```", 0) == 0) {
        is_yaml = line == "```yaml";
        if (is_yaml) blocks.push_back({page + ":" + std::to_string(number), page, ""});
      } else if (is_yaml) {
        blocks.back().text += line + "\n";
      }
    }
  }
  return blocks;
}

TEST(DocumentedYaml, IsWhatTheSchemasTake) {
  SchemaCheck check;
  for (const SchemaInfo& info : Schemas()) {
    Json schema = WholeSchema(info, nullptr);
    check.AddSchema(std::string(info.name), schema);
    schema.erase("required");
    check.AddSchema("part of " + std::string(info.name), schema);
  }
  const std::vector<Block> blocks = YamlBlocks();
  EXPECT_GT(blocks.size(), 15u);
  for (const Block& block : blocks) {
    Json document;
    try {
      document = JsonOf(ParseYamlText(block.text, block.where));
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
    const std::string format = document.is_object() ? document.value("format", "") : "";
    if (format.empty()) {
      ASSERT_EQ(kPages.count(block.page), 1u) << block.where << ": a part of what?";
      check.Add("part of " + kPages.at(block.page), document);
    } else {
      const std::size_t slash = format.find('/');
      check.Add(format.substr(slash + 1, format.rfind('/') - slash - 1), document);
    }
  }
  const std::vector<std::string> verdicts = check.Judge();
  for (std::size_t i = 0; i < blocks.size(); ++i) EXPECT_EQ(verdicts[i], "") << blocks[i].where;
}

}  // namespace
}  // namespace hexcal
