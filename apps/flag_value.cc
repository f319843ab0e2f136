// SPDX-License-Identifier: BSD-3-Clause
#include "apps/flag_value.h"

#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>
#include <locale.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "config/nearest_word.h"
#include "config/number.h"

namespace hexcal {
namespace {

// gflags reads and writes numbers by the locale of C: while this lives, that is "C" for this
// thread.
class PlainNumbers {
 public:
  PlainNumbers() : before_(uselocale(Plain())) {}
  ~PlainNumbers() { uselocale(before_); }
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

 private:
  static locale_t Plain() {
    static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    return plain;
  }
  locale_t before_;
};

gflags::CommandLineFlagInfo Info(const FlagSpec& spec) {
  const PlainNumbers numbers;
  gflags::CommandLineFlagInfo info;
  CHECK(gflags::GetCommandLineFlagInfo(std::string(spec.name).c_str(), &info)) << spec.name;
  return info;
}

bool InRange(const FlagSpec& spec, double value) {
  if (spec.low_excluded && value == spec.low) return false;
  return value >= spec.low && value <= spec.high;  // false for nan
}

// The value as gflags will read it back to the same bits, or nothing.
std::optional<std::string> Canonical(const FlagSpec& spec, std::string_view text) {
  if (IsSwitch(spec)) {
    if (text != "true" && text != "false") return std::nullopt;
    return std::string(text);
  }
  if (IsWholeNumber(spec)) {
    const std::optional<long> value = ParseInteger(text);
    if (!value || !InRange(spec, static_cast<double>(*value))) return std::nullopt;
    return fmt::format("{}", *value);
  }
  if (IsNumber(spec)) {
    const std::optional<double> value = ParseDouble(text);
    if (!value || !std::isfinite(*value) || !InRange(spec, *value)) return std::nullopt;
    return fmt::format("{}", *value);
  }
  const bool free = spec.choices.empty();
  const bool listed =
      std::find(spec.choices.begin(), spec.choices.end(), text) != spec.choices.end();
  if (free ? text.empty() : !listed) return std::nullopt;
  return std::string(text);
}

std::string JoinChoices(const std::vector<std::string_view>& choices) {
  std::string text(choices.front());
  for (std::size_t i = 1; i < choices.size(); ++i)
    text += fmt::format("{}{}", i + 1 == choices.size() ? " or " : ", ", choices[i]);
  return text;
}

}  // namespace

bool IsSwitch(const FlagSpec& spec) { return Info(spec).type == "bool"; }

bool IsWholeNumber(const FlagSpec& spec) {
  const std::string type = Info(spec).type;
  return type == "int32" || type == "int64";
}

bool IsNumber(const FlagSpec& spec) { return IsWholeNumber(spec) || Info(spec).type == "double"; }

bool WasGiven(const FlagSpec& spec) { return !Info(spec).is_default; }

std::string CurrentText(const FlagSpec& spec) {
  const std::string text = Info(spec).current_value;
  if (!IsNumber(spec) || IsWholeNumber(spec)) return text;
  const std::optional<double> value = ParseDouble(text);  // nan stays what it is
  return value ? fmt::format("{}", *value) : text;        // 1e-12, not 9.9999999999999998e-13
}

std::string DefaultText(const FlagSpec& spec) {
  if (!spec.default_text.empty()) return std::string(spec.default_text);
  std::string text = Info(spec).default_value;
  if (IsSwitch(spec)) return "";
  if (!IsNumber(spec)) return text;
  return IsWholeNumber(spec) ? text : fmt::format("{}", ParseDouble(text).value_or(0.0));
}

std::string ExpectedText(const FlagSpec& spec) {
  if (IsSwitch(spec)) return "true or false";
  if (!spec.choices.empty()) return JoinChoices(spec.choices);
  if (!IsNumber(spec))
    return spec.value == "NAME" ? "a name" : spec.value == "TEXT" ? "a text" : "a path";
  std::string text = IsWholeNumber(spec) ? "a whole number" : "a number";
  text += fmt::format(spec.low_excluded ? " above {}" : " from {}", spec.low);
  if (std::isfinite(spec.high))
    text += fmt::format(spec.low_excluded ? ", at most {}" : " to {}", spec.high);
  else
    text += " on";
  return text;
}

std::optional<std::string> SetFlag(const FlagSpec& spec, std::string_view text) {
  const std::optional<std::string> value = Canonical(spec, text);
  if (!value) return ExpectedText(spec) + DidYouMean(text, spec.choices);
  const std::string name(spec.name);
  const PlainNumbers numbers;
  CHECK(!gflags::SetCommandLineOption(name.c_str(), value->c_str()).empty()) << name;
  return std::nullopt;
}

}  // namespace hexcal
