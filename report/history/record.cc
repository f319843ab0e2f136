// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/covariance.h"
#include "report/json_parts.h"
#include "report/json_text.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "hexcal/history/1";
constexpr std::size_t kMostWarnings = 10;

Json MountObject(const Pose3d& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  return {{"xyz", JsonList(pose.translation)}, {"quaternion", {q.w(), q.x(), q.y(), q.z()}}};
}

Json CovarianceRows(const KnownMounts& known) {
  Json rows = Json::array();
  for (int i = 0; i < 12; ++i) {
    Json row = Json::array();
    for (int j = 0; j < 12; ++j)
      row.push_back(known.determined[i] && known.determined[j] ? Json(known.covariance(i, j))
                                                               : Json());
    rows.push_back(row);
  }
  return rows;
}

double NumberOf(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

Pose3d MountOf(const Json& object) {
  const auto xyz = object.at("xyz").get<std::array<double, 3>>();
  const auto q = object.at("quaternion").get<std::array<double, 4>>();
  return {Eigen::Vector3d(xyz[0], xyz[1], xyz[2]), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

bool IsPose(const Pose3d& pose) {
  return pose.translation.allFinite() && std::abs(pose.rotation.norm() - 1.0) < 1e-6;
}

void ReadCovariance(const Json& rows, KnownMounts* known) {
  for (int i = 0; i < 12; ++i) {
    known->determined[i] = !rows.at(i).at(i).is_null();
    for (int j = 0; j < 12; ++j)
      known->covariance(i, j) = rows.at(i).at(j).is_null() ? 0.0 : rows.at(i).at(j).get<double>();
  }
}

NoiseSide SideOf(const std::string& name) {
  for (const NoiseSide side : {NoiseSide::kRobot, NoiseSide::kBoth})
    if (NameOf(side) == name) return side;
  return NoiseSide::kTracker;
}

// What is in a record apart from the calibration's numbers.
void ReadIdentity(const Json& json, HistoryRecord* record) {
  record->number = json.at("number");
  record->previous = json.at("previous");
  record->written = json.at("written");
  record->author = {json.at("user"), json.at("host"), json.at("operator")};
  record->version = json.at("version");
  record->revision = json.value("revision", "");
  record->command = json.at("command");
  record->dataset = json.at("dataset");
  for (const Json& file : json.at("inputs"))
    record->inputs.push_back({file.at("file"), file.at("sha256")});
  record->readings_sha256 = json.at("readings_sha256");
  for (const auto& [name, value] : json.at("settings").items())
    record->settings.emplace_back(name, value);
  record->effects = json.at("effects").get<std::vector<std::string>>();
  record->warning_count = json.at("warnings").at("count");
  record->warnings = json.at("warnings").at("first").get<std::vector<std::string>>();
  record->result_sha256 = json.at("result_sha256");
}

void ReadNumbers(const Json& json, HistoryRecord* record) {
  record->solver = json.at("solver");
  record->residual = json.at("residual");
  record->error = json.at("error");
  record->is_converged = json.at("converged");
  record->is_trusted = json.at("trusted");
  record->poses = json.at("poses");
  record->known.mounts = {MountOf(json.at("world_from_base")),
                          MountOf(json.at("platform_from_tool"))};
  ReadCovariance(json.at("covariance"), &record->known);
  const Json& noise = json.at("noise");
  record->noise.position = NumberOf(noise.at("position"));
  record->noise.orientation = NumberOf(noise.at("orientation"));
  record->noise.estimated = noise.at("estimated");
  record->noise.assumed = SideOf(noise.at("assumed"));
  record->noise_scale = NumberOf(json.at("noise_scale"));
  record->chi_square = NumberOf(json.at("chi_square"));
  record->degrees_of_freedom = json.at("degrees_of_freedom");
  record->rmspe = NumberOf(json.at("rmspe"));
  record->rmsoe = NumberOf(json.at("rmsoe"));
}

}  // namespace

std::string HistoryRecord::Setting(std::string_view name) const {
  for (const auto& [setting, value] : settings)
    if (setting == name) return value;
  return "";
}

bool HistoryRecord::HasLoss() const {
  const std::string loss = Setting("loss");
  return !loss.empty() && loss != "none";
}

std::string TextOf(const Author& author) {
  const std::string account = author.user + "@" + author.host;
  return author.operator_name.empty() ? account
                                      : fmt::format("{} ({})", author.operator_name, account);
}

HistoryRecord MakeHistoryRecord(std::string_view command,
                                const std::string& readings,
                                const RunRecord& run,
                                const ResultHeader& header,
                                const Estimate& estimate,
                                const std::vector<Effect>& effects,
                                std::string_view result) {
  HistoryRecord record;
  record.written = run.started_utc;
  record.version = run.version.substr(0, run.version.find('\n'));
  record.revision = run.revision;
  record.command = command;
  record.dataset = header.dataset;
  record.inputs = HashFiles(run.inputs);
  record.readings_sha256 = HashFiles({readings}).front().sha256;
  record.settings = run.settings;
  record.solver = header.solver;
  record.residual = header.residual;
  record.error = header.error;
  record.is_converged = estimate.converged;
  record.is_trusted = estimate.IsTrustworthy();
  record.poses = static_cast<long>(estimate.poses.size());
  record.known = {estimate.mounts, estimate.covariance, estimate.observability.determined};
  record.noise = estimate.noise;
  record.noise_scale = estimate.noise_scale;
  record.chi_square = estimate.chi_square;
  record.degrees_of_freedom = estimate.degrees_of_freedom;
  record.rmspe = estimate.rmspe;
  record.rmsoe = estimate.rmsoe;
  for (const Effect& effect : effects) record.effects.push_back(effect.name);
  record.warning_count = static_cast<long>(estimate.warnings.size());
  record.warnings = estimate.warnings;
  record.warnings.resize(std::min(record.warnings.size(), kMostWarnings));
  record.result_sha256 = Sha256(result);
  return record;
}

std::string CanonicalText(const HistoryRecord& record) {
  Json json;
  json["format"] = kFormat;
  json["number"] = record.number;
  json["previous"] = record.previous;
  json["written"] = record.written;
  json["user"] = record.author.user;
  json["host"] = record.author.host;
  json["operator"] = record.author.operator_name;
  json["version"] = record.version;
  if (!record.revision.empty()) json["revision"] = record.revision;
  json["command"] = record.command;
  json["dataset"] = record.dataset;
  json["inputs"] = Json::array();
  for (const HashedFile& file : record.inputs)
    json["inputs"].push_back({{"file", file.path}, {"sha256", file.sha256}});
  json["readings_sha256"] = record.readings_sha256;
  json["settings"] = Json::object();
  for (const auto& [name, value] : record.settings) json["settings"][name] = value;
  json["solver"] = record.solver;
  json["residual"] = record.residual;
  json["error"] = record.error;
  json["converged"] = record.is_converged;
  json["trusted"] = record.is_trusted;
  json["poses"] = record.poses;
  json["world_from_base"] = MountObject(record.known.mounts.world_from_base);
  json["platform_from_tool"] = MountObject(record.known.mounts.platform_from_tool);
  json["covariance"] = CovarianceRows(record.known);
  json["noise"] = {{"position", record.noise.position},
                   {"orientation", record.noise.orientation},
                   {"estimated", record.noise.estimated},
                   {"assumed", std::string(NameOf(record.noise.assumed))}};
  json["noise_scale"] = record.noise_scale;
  json["chi_square"] = record.chi_square;
  json["degrees_of_freedom"] = record.degrees_of_freedom;
  json["rmspe"] = record.rmspe;
  json["rmsoe"] = record.rmsoe;
  json["effects"] = record.effects;
  json["warnings"] = {{"count", record.warning_count}, {"first", record.warnings}};
  json["result_sha256"] = record.result_sha256;
  return JsonLine(json);
}

std::optional<HistoryRecord> ParseRecord(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    if (json.at("format").get<std::string>() != kFormat) return std::nullopt;
    HistoryRecord record;
    ReadIdentity(json, &record);
    ReadNumbers(json, &record);
    const BaseAndTool& mounts = record.known.mounts;
    if (!IsPose(mounts.world_from_base) || !IsPose(mounts.platform_from_tool)) return std::nullopt;
    if (!IsCovariance(record.known.covariance)) return std::nullopt;
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace hexcal
