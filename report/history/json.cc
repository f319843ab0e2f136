// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/json.h"

#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json Problems(const HistoryCheck& check) {
  Json list = Json::array();
  for (const HistoryProblem& problem : check.problems)
    list.push_back(
        {{"record", problem.number == 0 ? Json() : Json(problem.number)}, {"what", problem.what}});
  return list;
}

Json TestObject(const ChartTest& test) {
  Json outside = Json::array();
  for (int i = 0; i < 12; ++i)
    if (test.outside[i]) outside.push_back(std::string(kParameters[i].name));
  return {{"in_control", test.is_in_control},
          {"deviation", JsonList(test.deviation)},
          {"half_width", JsonList(test.half_width)},
          {"outside", outside},
          {"t_squared", test.t_squared},
          {"t_squared_limit", test.t_squared_limit},
          {"p_value", test.p_value}};
}

Json PointObject(const DatasetTrend& trend, std::size_t index) {
  const HistoryRecord& record = trend.records[index];
  const TrendPoint& point = trend.trend.points[index];
  const long repeats = trend.repeats[index];
  Json object = {{"record", record.number},
                 {"written", record.written},
                 {"used", point.is_used},
                 {"same_readings_as", repeats > 0 ? Json(repeats) : Json()},
                 {"judged", point.is_judged},
                 {"in_control", point.is_judged ? Json(point.is_in_control) : Json()}};
  if (!point.is_used) return object;
  object["position"] = JsonList(point.position);
  if (point.step)
    object["step"] = {{"difference", JsonList(point.step->difference)},
                      {"sigmas", JsonList(point.step->sigmas)},
                      {"chi_square", point.step->chi_square},
                      {"p_value", point.step->p_value}};
  if (!point.is_judged) return object;
  object["level"] = TestObject(point.level);
  object["moving_mean"] = point.level.is_in_control ? TestObject(point.moving) : Json();
  return object;
}

Json TrendObject(const DatasetTrend& trend) {
  const MountTrend& all = trend.trend;
  Json points = Json::array();
  for (std::size_t i = 0; i < trend.records.size(); ++i) points.push_back(PointObject(trend, i));
  Json otherwise = Json::array();
  for (const std::size_t i : trend.made_otherwise)
    otherwise.push_back({{"record", trend.records[i].number}, {"way", WayOf(trend.records[i])}});
  Json object = {{"dataset", trend.dataset},
                 {"records", points},
                 {"in_control", all.in_control},
                 {"homogeneity_p_value", all.homogeneity_p},
                 {"scatter_shows", all.scatter_shows},
                 {"between", JsonList(all.between)},
                 {"drift", Json()},
                 {"made_otherwise", otherwise}};
  if (all.drift)
    object["drift"] = {{"rate", JsonList(all.drift->rate)},
                       {"standard_deviation", JsonList(all.drift->standard_deviation)},
                       {"scatter_shows", all.drift->scatter_shows},
                       {"statistic", all.drift->statistic},
                       {"p_value", all.drift->p_value}};
  return object;
}

}  // namespace

std::string HistoryListJson(const std::string& path,
                            const std::vector<StoredRecord>& rows,
                            const HistoryCheck& check) {
  Json records = Json::array();
  for (const StoredRecord& row : rows) {
    Json object = {{"number", row.number}, {"hash", row.hash}};
    for (std::size_t i = 0; i < kRepeated.size(); ++i)
      object[std::string(kRepeated[i])] = row.repeated[i];
    object["trusted"] = row.record && row.record->is_trusted;
    records.push_back(object);
  }
  return JsonLine({{"format", "hexcal/history_list/1"},
                   {"file", path},
                   {"head", check.head},
                   {"intact", check.is_intact()},
                   {"records", records}});
}

std::string HistoryRecordJson(const StoredRecord& row) {
  const Json text = Json::parse(row.text, nullptr, false);
  return JsonLine({{"format", "hexcal/history_record/1"},
                   {"hash", row.hash},
                   {"record", text.is_discarded() ? Json() : text}});
}

std::string HistoryTrendJson(const std::string& path,
                             const std::vector<DatasetTrend>& trends,
                             const DatasetTrendOptions& options) {
  Json list = Json::array();
  for (const DatasetTrend& trend : trends) list.push_back(TrendObject(trend));
  return JsonLine({{"format", "hexcal/history_trend/1"},
                   {"file", path},
                   {"since", options.since},
                   {"baseline", options.chart.baseline},
                   {"alpha", options.chart.alpha},
                   {"parameters", JsonParameterNames()},
                   {"datasets", list}});
}

std::string HistoryCheckJson(const std::string& path,
                             std::size_t records,
                             const HistoryCheck& check) {
  return JsonLine({{"format", "hexcal/history_check/1"},
                   {"file", path},
                   {"intact", check.is_intact()},
                   {"records", records},
                   {"head", check.head},
                   {"after_head", check.after_head},
                   {"problems", Problems(check)}});
}

}  // namespace hexcal
