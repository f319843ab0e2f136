// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_study.h"

#include <fmt/format.h>
#include <gflags/gflags.h>

#include <algorithm>
#include <optional>
#include <set>

#include "apps/batch_files.h"
#include "apps/batch_settings.h"
#include "apps/dataset_files.h"
#include "apps/discover.h"
#include "report/digest.h"

namespace hexcal {
namespace {

constexpr long kMostDraws = 10'000'000;
constexpr long kMostRecords = 100;
constexpr std::size_t kMostCells = 1000;
constexpr long kFewestPoses = 3;

long ReadCount(const YamlNode& node, long least, long most) {
  const std::string expected = fmt::format("a whole number from {} to {}", least, most);
  const long value = ReadInteger(node, expected);
  if (value < least || value > most)
    throw InputError(node.where, fmt::format("{}", value), expected);
  return value;
}

double ReadFactor(const YamlNode& node, double most) {
  const std::string expected = fmt::format("a number from 0 to {}", most);
  const double value = ReadNumber(node, expected);
  if (value < 0.0 || value > most) throw InputError(node.where, fmt::format("{}", value), expected);
  return value;
}

// One value or a list of them.
template <typename Read>
auto ReadOneOrMore(const YamlNode* node, decltype(std::declval<Read>()(YamlNode())) none, Read read)
    -> std::vector<decltype(none)> {
  if (node == nullptr) return {none};
  if (node->kind != YamlNode::Kind::kSequence) return {read(*node)};
  std::vector<decltype(none)> values;
  for (const YamlNode& item : node->items) values.push_back(read(item));
  if (values.empty()) throw InputError(node->where, "an empty list", "at least one number");
  return values;
}

// Names stand in results.csv: what they are there is what they are here.
std::string ReadUniqueName(const YamlNode& node, std::set<std::string>* taken) {
  constexpr std::string_view kExpected =
      "a name of at most 64 letters, digits, spaces, '.', '-' and '_'";
  const std::string name = ReadText(node, kExpected);
  const bool good =
      !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               std::string_view(" .-_").find(c) != std::string_view::npos;
      });
  if (!good || name[0] == ' ' || name[0] == '-' || name.back() == ' ')
    throw InputError(node.where, fmt::format("the name '{}'", name), kExpected);
  if (!taken->insert(name).second)
    throw InputError(node.where, fmt::format("the name '{}' again", name), "a name of its own");
  return name;
}

class StudyReader {
 public:
  StudyReader(const std::string& manifest_path, std::string* identity)
      : manifest_path_(manifest_path), identity_(identity) {}

  Study Read(const std::string& name, const MapReader& manifest) {
    const MapReader reader(
        manifest.Required("study"), "study", {"draws", "seed", "records", "scenarios"});
    Study study;
    study.name = name;
    study.draws = static_cast<int>(ReadCount(reader.Required("draws"), 1, kMostDraws));
    if (const YamlNode* seed = reader.Optional("seed"))
      study.seed = static_cast<std::uint64_t>(ReadCount(*seed, 0, (1L << 62)));
    if (const YamlNode* records = reader.Optional("records"))
      study.records = static_cast<int>(ReadCount(*records, 0, kMostRecords));
    std::set<std::string> names;
    for (const YamlNode& node : ReadSequence(reader.Required("scenarios"), "a list of scenarios"))
      AddScenario(node, &names, &study);
    if (study.cells.empty())
      throw InputError(reader.Required("scenarios").where, "no scenario", "at least one");
    ReadEstimators(manifest.Required("estimators"), &study);
    return study;
  }

 private:
  void AddFiles(const std::vector<std::string>& files) {
    for (const HashedFile& file : HashFiles(files)) *identity_ += file.sha256 + "\n";
  }

  Dataset Open(const YamlNode& node) {
    Dataset dataset =
        OpenDataset(FromManifest(manifest_path_, ReadText(node, "a dataset's file")), false);
    AddFiles(InputFiles(dataset, ""));
    return dataset;
  }

  void AddScenario(const YamlNode& node, std::set<std::string>* names, Study* study) {
    const MapReader reader(
        node,
        "a scenario",
        {"name", "dataset", "truth", "test", "noise", "poses", "effects", "noise_known"});
    const std::string name = ReadUniqueName(reader.Required("name"), names);
    const Dataset dataset = Open(reader.Required("dataset"));
    const std::string truth_path =
        FromManifest(manifest_path_, ReadText(reader.Required("truth"), "a model's file"));
    const Machine truth = ReadMachine(truth_path);
    AddFiles({truth_path});
    std::optional<Dataset> test;
    if (const YamlNode* other = reader.Optional("test")) test = Open(*other);
    const bool knows_noise =
        !reader.Has("noise_known") || ReadBool(*reader.Optional("noise_known"));
    const long rows = static_cast<long>(dataset.robot_poses.rows.size());
    const auto factor = [](const YamlNode& value) { return ReadFactor(value, 1e6); };
    for (const double noise : ReadOneOrMore(reader.Optional("noise"), 1.0, factor))
      for (const long poses :
           ReadOneOrMore(reader.Optional("poses"), 0L, [rows](const YamlNode& value) {
             return ReadCount(value, kFewestPoses, rows);
           }))
        for (const double effects : ReadOneOrMore(reader.Optional("effects"), 1.0, factor))
          study->cells.push_back(MakeStudyCell(name,
                                               dataset,
                                               truth,
                                               test ? &*test : nullptr,
                                               noise,
                                               static_cast<int>(poses),
                                               effects,
                                               knows_noise));
    if (study->cells.size() > kMostCells)
      throw InputError(node.where,
                       fmt::format("{} cells up to here", study->cells.size()),
                       fmt::format("at most {}", kMostCells));
  }

  void ReadEstimators(const YamlNode& list, Study* study) {
    std::set<std::string> names;
    for (const YamlNode& node : ReadSequence(list, "a list of estimators"))
      study->estimators.push_back(ReadEstimator(node, &names));
    if (study->estimators.empty()) throw InputError(list.where, "no estimator", "at least one");
    for (const StudyEstimator& estimator : study->estimators)
      RequireMarkers(estimator, *study, list.where);
  }

  // nonlinear, or {name: ..., method: ..., settings: {...}}.
  StudyEstimator ReadEstimator(const YamlNode& node, std::set<std::string>* names) {
    const gflags::FlagSaver flags_as_they_were;
    StudyEstimator estimator;
    const YamlNode* method = &node;
    const YamlNode* settings = nullptr;
    std::optional<MapReader> reader;
    if (node.kind == YamlNode::Kind::kMap) {
      reader.emplace(
          node, "an estimator", std::vector<std::string_view>{"name", "method", "settings"});
      method = &reader->Required("method");
      settings = reader->Optional("settings");
    }
    estimator.name =
        ReadUniqueName(reader && reader->Has("name") ? *reader->Optional("name") : *method, names);
    ReadMethod(*method, &estimator);
    ApplyBatchSettings(estimator.discovers ? "discover" : "calibrate", settings);
    if (estimator.discovers)
      estimator.discover = DiscoverOptionsFromFlags();
    else
      estimator.calibrate = OptionsAt(settings);
    estimator.discover.threads = estimator.calibrate.threads = 1;
    return estimator;
  }

  static void ReadMethod(const YamlNode& node, StudyEstimator* estimator) {
    std::string known = "discover";
    for (const MethodInfo& info : kMethods) known += fmt::format(", {}", info.name);
    const std::string name = ReadText(node, known);
    estimator->discovers = name == "discover";
    const auto found = std::find_if(
        kMethods.begin(), kMethods.end(), [&](const MethodInfo& m) { return m.name == name; });
    if (found == kMethods.end() && !estimator->discovers)
      throw InputError(node.where, fmt::format("the method '{}'", name), known);
    if (!estimator->discovers) estimator->method = found->method;
  }

  static void RequireMarkers(const StudyEstimator& estimator,
                             const Study& study,
                             const Location& where) {
    if (estimator.discovers || estimator.method != Method::kMarker) return;
    for (const StudyCell& cell : study.cells)
      if (cell.dataset.measurement->kind != Measurement::Kind::kMarkers)
        throw InputError(
            where,
            fmt::format("the method marker, and scenario '{}' of measured poses", cell.scenario),
            "scenarios with markers for it");
  }

  std::string manifest_path_;
  std::string* identity_;
};

}  // namespace

Study ReadStudy(const std::string& manifest_path,
                const std::string& name,
                const MapReader& manifest,
                std::string* identity) {
  return StudyReader(manifest_path, identity).Read(name, manifest);
}

}  // namespace hexcal
