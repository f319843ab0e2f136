// SPDX-License-Identifier: BSD-3-Clause
#include "report/written_json.h"

#include "report/json_text.h"

namespace hexcal {

std::string WrittenJsonLine(std::string_view command,
                            const std::vector<std::string>& files,
                            const std::vector<std::pair<std::string, std::size_t>>& counts) {
  nlohmann::ordered_json json = {
      {"format", "hexcal/written/1"}, {"command", command}, {"files", files}};
  for (const auto& [name, count] : counts) json[name] = count;
  return JsonLine(json);
}

}  // namespace hexcal
