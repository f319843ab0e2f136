// SPDX-License-Identifier: BSD-3-Clause
// The JSON Schemas of what hexcal reads, held against the readers themselves: whole samples, and
// thousands of mistakes in them, judged by both.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "apps/batch_manifest.h"
#include "apps/config_file.h"
#include "apps/schemas.h"
#include "measurement/dataset.h"
#include "measurement/importers/column_map.h"
#include "measurement/pivoting.h"
#include "model/machine.h"
#include "report/requirement.h"
#include "testing/json_schema.h"
#include "testing/schema_samples.h"
#include "testing/temporary_folder.h"

#include <gflags/gflags.h>

namespace hexcal {
namespace {

namespace fs = std::filesystem;
using ::hexcal::testing::Json;
using ::hexcal::testing::JsonOf;
using ::hexcal::testing::SchemaCheck;
using ::hexcal::testing::TemporaryFolder;

Json Schema(std::string_view name, const Command* command = nullptr) {
  return WholeSchema(*FindSchema(name), command);
}

// Why the reader refuses a file of this kind; empty where it takes it.
std::string Refusal(const std::string& kind, const std::string& path) {
  try {
    if (kind == "dataset") ReadDataset(path, false);
    if (kind == "model") ReadMachine(path);
    if (kind == "requirement") ReadRequirements(path);
    if (kind == "columns") ReadColumnMap(path);
    if (kind == "pivoting") ReadPivoting(path);
    if (kind == "batch") {
      const gflags::FlagSaver flags_as_they_were;
      ReadManifest(path);
    }
    if (kind == "settings") {
      const gflags::FlagSaver flags_as_they_were;
      CommandLine line;
      line.command = FindCommand("calibrate");
      ApplyConfigFile(path, line);
    }
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// ---- one mistake in a document

// Every document that differs from this one by one mistake: a key more, a key less, another value.
class Mistakes {
 public:
  // In the part that the pointer names.
  Mistakes(const Json& document, const std::string& part) : whole_(document) {
    Visit(Json::json_pointer(part));
  }
  const std::vector<Json>& all() const { return all_; }

 private:
  void Put(const Json::json_pointer& at, const Json& value) {
    all_.push_back(whole_);
    all_.back()[at] = value;
  }

  void Visit(const Json::json_pointer& at) {
    const Json node = whole_[at];
    for (const Json& other : {Json(),
                              Json(true),
                              Json("zz word"),
                              Json("12"),
                              Json(-7.5),
                              Json(1e30),
                              Json(0),
                              Json::array(),
                              Json::object(),
                              Json::array({1})})
      if (other != node) Put(at, other);
    if (node.is_array() && !node.empty()) {
      Json longer = node, shorter = node;
      longer.push_back(node.back());
      shorter.erase(shorter.size() - 1);
      Put(at, longer);
      Put(at, shorter);
      // Of long lists and tables the first item stands for all.
      for (std::size_t i = 0; i < std::min<std::size_t>(node.size(), node[0].is_object() ? 99 : 1);
           ++i)
        if (!at.empty() && at.back() != "rows") Visit(at / i);
    }
    if (!node.is_object()) return;
    Json more = node;
    more["zzzz"] = 1;
    Put(at, more);
    for (const auto& [key, value] : node.items()) {
      Json less = node;
      less.erase(key);
      Put(at, less);
      Visit(at / key);
    }
  }

  const Json whole_;
  std::vector<Json> all_;
};

// What only the reader can see: it compares values with each other, or looks at tables and files.
bool IsBeyondSchemas(const std::string& refusal) {
  for (const char* part : testing::kBeyondSchemas)
    if (refusal.find(part) != std::string::npos) return true;
  return false;
}

void CollectKeys(const Json& schema, std::set<std::string>& keys);

// What the reader lists as its keys when it meets an unknown one, the schema knows, too.
void ExpectKeysKnown(const std::string& refusal, const std::set<std::string>& known) {
  if (refusal.find("the unknown key 'zzzz'") == std::string::npos) return;
  for (const char* start : {"expected one of ", "expected only "}) {
    const std::size_t at = refusal.find(start);
    if (at == std::string::npos) continue;
    std::istringstream words(refusal.substr(at + std::string(start).size()));
    for (std::string word; words >> word;) {
      if (word.back() == ',') word.pop_back();
      EXPECT_EQ(known.count(word), 1u) << word << " of " << refusal;
    }
  }
}

// Judged by both, every mistake in every sample of a kind.
void ExpectTheSameOfMistakes(const std::string& kind,
                             const Json& schema,
                             const std::vector<Json>& samples) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : testing::SampleTables()) folder.Write(name, content);
  SchemaCheck check;
  check.AddSchema(kind, schema);
  std::vector<Json> documents;
  for (const Json& sample : samples) {
    documents.push_back(sample);
    // All of the first ones; of later models the effect, for the rest is the same.
    const bool differs = kind != "model" || &sample == &samples[0];
    const Mistakes mistakes(sample, differs ? "" : "/effects/0");
    documents.insert(documents.end(), mistakes.all().begin(), mistakes.all().end());
  }
  for (const Json& document : documents) check.Add(kind, document);
  const std::vector<std::string> verdicts = check.Judge();
  std::set<std::string> known;
  CollectKeys(schema, known);
  int refused = 0;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    const std::string text = documents[i].dump();
    const std::string refusal = Refusal(kind, folder.Write("sample.yaml", text));
    refused += refusal.empty() ? 0 : 1;
    ExpectKeysKnown(refusal, known);
    if (refusal.empty()) {
      EXPECT_EQ(verdicts[i], "") << text;
    } else if (verdicts[i].empty()) {
      EXPECT_TRUE(IsBeyondSchemas(refusal)) << refusal << "\n" << text;
    }
  }
  EXPECT_GT(refused, static_cast<int>(documents.size()) / 3);
}

// Every key that a schema knows stands in a sample, which the reader takes: it knows no other keys.
void CollectKeys(const Json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties"))
    for (const auto& [key, value] : schema["properties"].items()) keys.insert(key);
  if (!schema.is_structured()) return;
  for (const Json& part : schema) CollectKeys(part, keys);
}

void CollectDocumentKeys(const Json& document, std::set<std::string>& keys) {
  if (document.is_object())
    for (const auto& [key, value] : document.items()) keys.insert(key);
  if (!document.is_structured()) return;
  for (const Json& part : document) CollectDocumentKeys(part, keys);
}

void ExpectEveryKeyUsed(const Json& schema, const std::vector<Json>& samples) {
  std::set<std::string> known, used;
  CollectKeys(schema, known);
  for (const Json& sample : samples) CollectDocumentKeys(sample, used);
  for (const std::string& key : known) EXPECT_EQ(used.count(key), 1u) << key;
}

std::vector<Json> Parsed(const std::vector<std::string>& texts) {
  std::vector<Json> documents;
  for (const std::string& text : texts) documents.push_back(JsonOf(ParseYamlText(text, "sample")));
  return documents;
}

void ExpectAgreement(const std::string& kind,
                     const std::vector<Json>& samples,
                     const Command* command = nullptr) {
  const Json schema = Schema(kind, command);
  ExpectEveryKeyUsed(schema, samples);
  ExpectTheSameOfMistakes(kind, schema, samples);
}

// Each of these settings with a value that it may have.
Json OneOfEach(const Json& schema) {
  Json all;
  for (const auto& [name, flag] : schema["properties"].items())
    all[name] = flag.contains("enum")       ? flag["enum"].back()
                : flag["type"] == "boolean" ? Json(true)
                : flag["type"] == "integer" ? flag["minimum"]
                : flag["type"] == "number"  ? Json(0.125)
                                            : Json("word");
  return all;
}

TEST(Schema, OfDatasetsAgreesWithTheReader) {
  ExpectAgreement("dataset", Parsed(testing::DatasetSamples()));
}
TEST(Schema, OfModelsAgreesWithTheReader) {
  ExpectAgreement("model", Parsed(testing::ModelSamples()));
}
TEST(Schema, OfRequirementsAgreesWithTheReader) {
  ExpectAgreement("requirement", Parsed(testing::RequirementSamples()));
}
TEST(Schema, OfColumnMapsAgreesWithTheReader) {
  ExpectAgreement("columns", Parsed(testing::ColumnSamples()));
}
TEST(Schema, OfPivotingsAgreesWithTheReader) {
  ExpectAgreement("pivoting", Parsed(testing::PivotingSamples()));
}
TEST(Schema, OfManifestsAgreesWithTheReader) {
  const auto sample = [](const char* name) {
    Json manifest = {{"format", "hexcal/batch/1"}, {"name", "all"}, {"command", name}};
    manifest["datasets"] = {"a.yaml", "b.yaml"};
    manifest["settings"] = OneOfEach(Schema("batch")["$defs"][std::string(name) + "_settings"]);
    return manifest;
  };
  std::vector<Json> samples = Parsed(testing::StudySamples());
  samples.push_back(sample("calibrate"));
  samples.push_back(sample("discover"));
  ExpectAgreement("batch", samples);
}

TEST(Schema, OfSettingsAgreesWithTheReader) {
  const Command* command = FindCommand("calibrate");
  ExpectAgreement("settings", {OneOfEach(Schema("settings", command))}, command);
}

// ---- all of them

TEST(Schema, AreSchemasThatReferToNothingElse) {
  SchemaCheck check;
  for (const SchemaInfo& info : Schemas()) {
    check.AddSchema(std::string(info.name), WholeSchema(info, nullptr));
    check.Add(std::string(info.name), Json("nothing of the kind"));
  }
  for (const Command& command : Commands()) {
    const std::string name = "settings of " + std::string(command.name);
    check.AddSchema(name, Schema("settings", &command));
    check.Add(name, Json::object({{"zzzz", 1}}));
  }
  for (const std::string& verdict : check.Judge()) EXPECT_NE(verdict, "");
}

// Datasets, models, requirements and maps that come with hexcal; a kind by the file's first key.
TEST(Schema, AcceptWhatComesWithHexcal) {
  SchemaCheck check;
  for (const SchemaInfo& info : Schemas())
    check.AddSchema(std::string(info.name), WholeSchema(info, nullptr));
  std::vector<std::string> paths;
  for (const char* folder : {HEXCAL_SOURCE "/examples", HEXCAL_SOURCE "/tests/data"})
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".yaml") continue;
      const Json document = JsonOf(ParseYamlFile(entry.path().string()));
      const std::string format = document.is_object() ? document.value("format", "") : "";
      const std::size_t slash = format.find('/');
      if (slash == std::string::npos) continue;
      check.Add(format.substr(slash + 1, format.rfind('/') - slash - 1), document);
      paths.push_back(entry.path().string());
    }
  EXPECT_GT(paths.size(), 12u);
  const std::vector<std::string> verdicts = check.Judge();
  for (std::size_t i = 0; i < paths.size(); ++i) EXPECT_EQ(verdicts[i], "") << paths[i];
}

// tests/bad_datasets: of a mistake in the YAML file the schema says so, too, unless it is one of
// values against each other.
TEST(Schema, RefusesBadDatasets) {
  SchemaCheck check;
  check.AddSchema("dataset", Schema("dataset"));
  std::vector<std::string> messages;
  for (const auto& entry : fs::directory_iterator(HEXCAL_SOURCE "/tests/bad_datasets")) {
    std::string message;
    std::getline(std::ifstream(entry.path() / "expected.txt") >> std::ws, message);
    if (message.rfind("dataset.yaml", 0) != 0) continue;
    try {
      check.Add("dataset", JsonOf(ParseYamlFile((entry.path() / "dataset.yaml").string())));
    } catch (const InputError&) {
      continue;  // no YAML that hexcal takes
    }
    messages.push_back(entry.path().filename().string() + ": " + message);
  }
  EXPECT_GT(messages.size(), 40u);
  const std::vector<std::string> verdicts = check.Judge();
  int refused = 0;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    refused += verdicts[i].empty() ? 0 : 1;
    if (!verdicts[i].empty()) continue;
    EXPECT_TRUE(IsBeyondSchemas(messages[i])) << messages[i];
  }
  EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace hexcal
