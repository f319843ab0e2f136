// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <sstream>

#include "fuzz/readers.h"
#include "report/earlier_result.h"
#include "report/export/calibration.h"
#include "report/history/check.h"
#include "report/history/json.h"
#include "report/history/text.h"
#include "report/requirement.h"

namespace hexcal::fuzz {
namespace {

void ReadRequirement(const std::string&, const std::string& path, const Reader&) {
  ReadRequirements(path);
}

void ReadResult(const std::string&, const std::string& path, const Reader&) {
  ReadEarlierResult(path);
}

// As export begins.
void ReadExported(const std::string&, const std::string& path, const Reader&) {
  ReadCalibration(path);
}

// As hexcal history shows it. Text may be what it likes, but a record is written again as it is.
void ReadRecord(const std::string&, const std::string& path, const Reader&) {
  StoredRecord row;
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  row.text = bytes.str();
  row.record = ParseRecord(row.text);
  if (!row.record) return;
  const std::string again = CanonicalText(*row.record);
  if (CanonicalText(ParseRecord(again).value()) != again) throw std::logic_error("another record");
  CheckHistory({row});
  HistoryListText({row});
  HistoryRecordText(row);
  HistoryRecordJson(row);
  TrendsOf({row, row, row}, {});
}

void ReadDatabase(const std::string&, const std::string& path, const Reader&) {
  const std::vector<StoredRecord> rows = ReadHistory(path);
  HistoryListJson(path, rows, CheckHistory(rows));
  HistoryListText(rows);
  for (const StoredRecord& row : rows) HistoryRecordText(row);
}

void ReadTip(const std::string& folder, const std::string&, const Reader& self) {
  const std::string path = folder + "/requirement.yaml";
  std::ofstream(path)
      << "format: hexcal/requirement/1\nunits: {length: mm, angle: deg}\n"
         "points:\n  - {name: tip, pivot: "
      << self.file
      << "}\nrobot: {position: 0.005, orientation: 0.002, from: nowhere}\n"
         "requirements:\n  - {name: one, point: tip, limit: 1, probability: 0.95}\n";
  ReadRequirements(path);
}

}  // namespace

std::vector<Reader> ReportReaders() {
  return {{"requirement", "fuzzed.yaml", &ReadRequirement},
          {"earlier_result", "fuzzed.json", &ReadResult},
          {"calibration", "fuzzed.json", &ReadExported},
          {"history", "fuzzed.db", &ReadDatabase},
          {"history_record", "fuzzed.json", &ReadRecord},
          {"pivot_point", "fuzzed.json", &ReadTip}};
}

}  // namespace hexcal::fuzz
