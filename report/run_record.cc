// SPDX-License-Identifier: BSD-3-Clause
#include "report/run_record.h"

#include "report/json_text.h"

namespace hexcal {

std::string RunJson(const RunRecord& record) {
  nlohmann::ordered_json versions = nlohmann::ordered_json::array();
  std::string line;
  for (const char c : record.version) {
    if (c != '\n') {
      line += c;
      continue;
    }
    versions.push_back(line);
    line.clear();
  }
  nlohmann::ordered_json run;
  run["format"] = "hexcal/run/1";
  run["versions"] = versions;
  run["revision"] = record.revision;
  run["settings"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : record.settings) run["settings"][name] = value;
  run["inputs"] = record.inputs;
  run["started"] = record.started_utc;
  run["seconds"] = record.seconds;
  run["threads"] = record.threads;
  run["host"] = {{"name", record.host.name},
                 {"processors", record.host.processors},
                 {"system", record.host.system}};
  for (const MethodTime& m : record.methods)
    run["methods"].push_back({{"name", m.name},
                              {"seconds", m.seconds},
                              {"seconds_per_iteration",
                               m.iterations > 0 ? nlohmann::ordered_json(m.seconds / m.iterations)
                                                : nlohmann::ordered_json()}});
  if (record.history)
    run["history"] = {{"file", record.history->file},
                      {"record", record.history->number},
                      {"head", record.history->head}};
  return JsonText(run);
}

}  // namespace hexcal
