// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hexcal {

// Text as it may stand in an element or in a quoted attribute: & < > " ' become entities, control
// characters and bytes that are not UTF-8 the replacement character.
std::string EscapeHtml(std::string_view text);

// Text for a label of a chart, which would read tags like <b> in it.
std::string EscapeLabel(std::string_view text);

// JSON that cannot end the <script> in which it stands.
std::string JsonForScript(const nlohmann::ordered_json& value);

// The same of JSON as text, which may have < in its strings only: nothing else is changed.
std::string JsonTextForScript(std::string_view json);

// 'sha256-...' for a Content-Security-Policy.
std::string PolicyHash(std::string_view text);

}  // namespace hexcal
