// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// The files of apps/schemas/, embedded when hexcal was built: JSON Schemas whose references may
// point to definitions of common.json or to generated ones (schema_parts.h).
std::string_view CommonSchemaText();
std::string_view BatchSchemaText();
std::string_view DatasetSchemaText();
std::string_view ModelSchemaText();
std::string_view RequirementSchemaText();
std::string_view ColumnsSchemaText();
std::string_view ResultSchemaText();
std::string_view DiscoverySchemaText();
std::string_view AuditSchemaText();
std::string_view CompareSchemaText();
std::string_view PlanSchemaText();
std::string_view PivotingSchemaText();
std::string_view PivotSchemaText();
std::string_view RunSchemaText();
std::string_view WrittenSchemaText();
std::string_view HistoryListSchemaText();
std::string_view HistoryRecordSchemaText();
std::string_view HistoryTrendSchemaText();
std::string_view HistoryCheckSchemaText();
std::string_view BatchCountsSchemaText();

}  // namespace hexcal
