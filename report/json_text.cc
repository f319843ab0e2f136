// SPDX-License-Identifier: BSD-3-Clause
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

bool IsListOfStructures(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_structured();
}

std::string ListText(const Json& list) {
  std::string text = "[";
  for (std::size_t i = 0; i < list.size(); ++i)
    text += (i == 0 ? "\n    " : ",\n    ") + JsonLine(list[i]);
  return text + "]";
}

}  // namespace

std::string JsonLine(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string JsonText(const Json& object) {
  std::string text = "{";
  for (auto item = object.begin(); item != object.end(); ++item) {
    text += item == object.begin() ? "\n  " : ",\n  ";
    text += JsonLine(Json(item.key())) + ": ";
    text += IsListOfStructures(item.value()) ? ListText(item.value()) : JsonLine(item.value());
  }
  return text + "\n}\n";
}

}  // namespace hexcal
