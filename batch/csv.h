// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "batch/job.h"
#include "batch/row.h"

namespace hexcal {

// status and message, which every batch has, and the job's own.
std::vector<Column> AllColumns(const Job& job);

// Any text as one that CSV needs no quoting for and spreadsheets take for no formula, on one line
// and of at most 300 characters.
std::string PlainText(std::string_view text);

// The row of an outcome, its texts plain and without NaN: what is stored and written.
Row MakeRow(std::int64_t index, const Outcome& outcome, const std::vector<Column>& all_columns);

// "study,idx,status,message,...\n" and a row of it. Numbers keep all their bits.
std::string CsvHeader(const std::vector<Column>& all_columns);
std::string CsvLine(const std::string& study, const Row& row);
void AppendCsvLine(const std::string& study, const Row& row, std::string* text);

}  // namespace hexcal
