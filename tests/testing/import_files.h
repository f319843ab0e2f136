// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "measurement/importers/formats.h"
#include "testing/input_error_text.h"
#include "testing/temporary_folder.h"

namespace hexcal::testing {

inline std::string ImportPath(std::string_view name) {
  return std::string(HEXCAL_IMPORT_DATA) + "/" + std::string(name);
}

inline std::string ImportText(std::string_view name) {
  std::ostringstream text;
  text << std::ifstream(ImportPath(name), std::ios::binary).rdbuf();
  return text.str();
}

// text with the first `from` replaced; a test that replaces nothing is wrong.
inline std::string Replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "no '" << from << "' to replace";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline Recording ReadImportText(std::string_view format,
                                std::string_view text,
                                const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  return ReadRecording(*FindImportFormat(format), folder.Write("in", text), options);
}

// The message without the folder: "in:3:5: found ..., expected ...".
inline std::string ImportErrorIn(const TemporaryFolder& folder,
                                 std::string_view format,
                                 std::string_view text,
                                 const ImportOptions& options = {}) {
  const std::string path = folder.Write("in", text);
  std::string message =
      InputErrorText([&] { ReadRecording(*FindImportFormat(format), path, options); });
  const std::string prefix = folder.Path("");
  for (std::size_t at = 0; (at = message.find(prefix)) != std::string::npos;)
    message.erase(at, prefix.size());
  return message;
}

inline std::string ImportError(std::string_view format,
                               std::string_view text,
                               const ImportOptions& options = {}) {
  return ImportErrorIn(TemporaryFolder(), format, text, options);
}

// Every beginning of a good file is taken or refused with an InputError, and so is the file with
// any one byte changed (a step apart): nothing else may happen. take: reads the text, gives the
// error. Counts how many were refused.
template <typename Take>
int RefusedOfDamaged(Take&& take, const std::string& good, std::size_t step) {
  int refused = 0;
  const auto count = [&](const std::string& text) {
    const std::string message = take(text);
    EXPECT_EQ(message.find("(another exception"), std::string::npos) << message;
    refused += message == "(no exception)" ? 0 : 1;
  };
  for (std::size_t size = 0; size < good.size(); size += step) count(good.substr(0, size));
  for (std::size_t at = 0; at < good.size(); at += step) {
    for (const char byte : {'\0', '\n', '-', '9', '\xff'}) {
      std::string bad = good;
      bad[at] = byte;
      count(bad);
    }
  }
  return refused;
}

inline int RefusedOfDamagedFiles(std::string_view format,
                                 const std::string& good,
                                 std::size_t step,
                                 const ImportOptions& options = {}) {
  const TemporaryFolder folder;
  return RefusedOfDamaged(
      [&](const std::string& text) { return ImportErrorIn(folder, format, text, options); },
      good,
      step);
}

}  // namespace hexcal::testing
