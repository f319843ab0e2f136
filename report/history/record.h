// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "estimator/mount_change.h"
#include "report/digest.h"
#include "report/result_json.h"
#include "report/run_record.h"

namespace hexcal {

// Who calibrated, as the system knows it, and as they call themselves.
struct Author {
  std::string user, host, operator_name;
};
std::string TextOf(const Author& author);  // "operator (user@host)", "user@host"

// A calibration as a history keeps it (docs/history.md). SI units.
struct HistoryRecord {
  long number = 0;       // 1, 2, 3... in its file
  std::string previous;  // the hash of the record before; of the first, kNoHash
  std::string written;   // ISO 8601, UTC
  Author author;
  std::string version;   // of hexcal
  std::string revision;  // the commit it was built from; empty: an older record, which has none
  std::string command, dataset;
  std::vector<HashedFile> inputs;
  std::string readings_sha256;  // of the input that holds what the tracker read
  std::vector<std::pair<std::string, std::string>> settings;  // flags and their values
  std::string solver, residual, error;
  bool is_converged = false, is_trusted = false;
  long poses = 0;
  KnownMounts known;
  NoiseSummary noise;  // without markers' own
  double noise_scale = 1.0, chi_square = 0.0;
  long degrees_of_freedom = 0;
  double rmspe = 0.0, rmsoe = 0.0;
  std::vector<std::string> effects;  // names, of those estimated with base and tool
  long warning_count = 0;
  std::vector<std::string> warnings;  // the first of them
  std::string result_sha256;          // of result.json

  std::string Setting(std::string_view name) const;  // empty: no such one
  // Then chi_square is the loss's, which chance makes smaller.
  bool HasLoss() const;
};

inline constexpr std::string_view kNoHash =
    "0000000000000000000000000000000000000000000000000000000000000000";

// What a run is to be remembered by; number, previous and author are left to others. readings: the
// path of the input that holds what the tracker read; result: the text of result.json. InputError
// where an input cannot be read any more.
HistoryRecord MakeHistoryRecord(std::string_view command,
                                const std::string& readings,
                                const RunRecord& run,
                                const ResultHeader& header,
                                const Estimate& estimate,
                                const std::vector<Effect>& effects,
                                std::string_view result);

// The one text of a record: JSON on one line, keys in a fixed order, numbers in the fewest digits
// that read back the same, UTF-8 (other bytes become the replacement character). Its SHA-256 is the
// record's hash.
std::string CanonicalText(const HistoryRecord& record);

// Nothing where the text is not that of a record.
std::optional<HistoryRecord> ParseRecord(std::string_view text);

}  // namespace hexcal
