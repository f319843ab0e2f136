// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hexcal {

// JSON for people to read too: a key of the object a line, an entry of a list of objects or of
// lists a line. Ends with a newline. Not-a-number and infinities become null, bytes that are not
// UTF-8 the replacement character.
std::string JsonText(const nlohmann::ordered_json& object);

// All on one line, without a newline.
std::string JsonLine(const nlohmann::ordered_json& value);

}  // namespace hexcal
