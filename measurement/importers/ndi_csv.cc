// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/ndi_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "config/number.h"
#include "measurement/checked_values.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr std::string_view kOk = "ok";
constexpr std::string_view kGroup[] = {"state", "tx", "ty", "tz"};
constexpr std::size_t kGroupSize = 4;
constexpr const char* kHeader =
    "the header of an NDI wide CSV: Tools, then for each tool Port..., Frame, State, Q0, Qx, Qy, "
    "Qz, Tx, Ty, Tz, Error, Markers and State, Tx, Ty, Tz for each marker";

bool IsPort(std::string_view cell) { return LowerCase(cell).find("port") != std::string::npos; }

// The columns of one tool, relative to that of its port.
struct Block {
  std::string port;
  std::map<std::string, std::size_t> columns;  // by name in small letters
  std::size_t width = 1;
  std::size_t first_group = 0;
  std::size_t groups = 0;

  bool Has(const std::string& name) const { return columns.count(name) > 0; }
};

class NdiCsv {
 public:
  NdiCsv(const std::string& path, const ImportOptions& options)
      : reader_(path), missing_value_(options.missing_value) {
    recording_.path = path;
  }

  Recording Read() {
    ReadHeader();
    while (reader_.Next()) {
      if (Trimmed(reader_.Line()).empty()) continue;
      ReadRow();
    }
    if (recording_.rows == 0)
      throw InputError(reader_.File(), "no row below the header", "a row for each frame");
    for (const auto& [state, count] : not_ok_)
      recording_.warnings.push_back(
          fmt::format("{}: {} not used, {} state being '{}'",
                      recording_.path,
                      count == 1 ? "1 tool" : fmt::format("{} tools", count),
                      count == 1 ? "its" : "their",
                      state));
    if (recording_.frames.size() != recording_.rows) recording_.frames.clear();
    WarnOfZeros(recording_);
    recording_.reading = "mm, quaternions scalar first";
    return std::move(recording_);
  }

 private:
  void ReadHeader() {
    if (!reader_.Next()) throw InputError(reader_.File(), "an empty file", kHeader);
    reader_.Split(',');
    reader_.DropEmptyEnd(1);
    if (LowerCase(reader_.Text(0)) != "tools")
      throw InputError(reader_.At(0), Quoted(reader_.Text(0)), kHeader);
    std::size_t column = 1;
    while (column < reader_.size()) column += ReadBlock(column);
    if (blocks_.empty()) throw InputError(reader_.Where(), "no column 'Port...'", kHeader);
  }

  std::size_t ReadBlock(std::size_t begin) {
    static const std::vector<std::string> kKnown = {"frame",
                                                    "time [sec]",
                                                    "face",
                                                    "state",
                                                    "q0",
                                                    "qx",
                                                    "qy",
                                                    "qz",
                                                    "tx",
                                                    "ty",
                                                    "tz",
                                                    "error",
                                                    "markers"};
    if (!IsPort(reader_.Text(begin)))
      throw InputError(reader_.At(begin), Quoted(reader_.Text(begin)), "a column 'Port...'");
    Block block;
    block.port = reader_.Text(begin);
    std::size_t i = begin + 1;
    for (; i < reader_.size() && !block.Has("markers") && !IsPort(reader_.Text(i)); ++i) {
      const std::string name = LowerCase(reader_.Text(i));
      const bool is_known = std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
      if (!is_known || !block.columns.emplace(name, i - begin).second)
        throw InputError(reader_.At(i),
                         fmt::format("the column {}", Quoted(reader_.Text(i))),
                         "each once: Frame, Time [sec], Face, State, Q0, Qx, Qy, Qz, Tx, Ty, Tz, "
                         "Error, Markers");
    }
    for (const char* needed : {"state", "q0", "qx", "qy", "qz", "tx", "ty", "tz"})
      if (!block.Has(needed))
        throw InputError(reader_.At(begin),
                         fmt::format("no column '{}' for {}", needed, Quoted(block.port)),
                         kHeader);
    block.first_group = i - begin;
    for (; i < reader_.size() && !IsPort(reader_.Text(i)); i += kGroupSize, ++block.groups)
      CheckGroup(i);
    block.width = i - begin;
    AddBlock(std::move(block), begin);
    return i - begin;
  }

  void CheckGroup(std::size_t begin) const {
    for (std::size_t k = 0; k < kGroupSize; ++k) {
      const bool is_there = begin + k < reader_.size();
      if (is_there && LowerCase(reader_.Text(begin + k)) == kGroup[k]) continue;
      throw InputError(reader_.At(begin + k),
                       is_there ? Quoted(reader_.Text(begin + k)) : "the end of the line",
                       "State, Tx, Ty, Tz for each marker");
    }
  }

  void AddBlock(Block block, std::size_t column) {
    for (const Block& other : blocks_)
      if (other.port == block.port)
        throw InputError(reader_.At(column),
                         fmt::format("{} a second time", Quoted(block.port)),
                         "each tool once");
    RecordedBody body{block.port, Aliases(block.port), {}};
    for (std::size_t k = 0; k < block.groups; ++k) {
      body.markers.push_back(static_cast<int>(recording_.markers.size()));
      recording_.markers.push_back({std::to_string(k + 1), {}});
    }
    recording_.bodies.push_back(std::move(body));
    blocks_.push_back(std::move(block));
  }

  // "Port 0x01: JJH Probe  s/n:3E4C880C" may be called 0x01, JJH Probe or 3E4C880C.
  static std::vector<std::string> Aliases(std::string_view port) {
    std::vector<std::string> aliases;
    const auto add = [&aliases](std::string_view text) {
      if (!Trimmed(text).empty()) aliases.emplace_back(Trimmed(text));
    };
    const std::size_t colon = port.find(':');
    const std::size_t word = LowerCase(port).find("port");
    add(port.substr(word + 4, colon == std::string_view::npos ? colon : colon - word - 4));
    if (colon == std::string_view::npos || colon < word) return aliases;
    const std::string_view rest = port.substr(colon + 1);
    const std::size_t serial = rest.rfind("s/n:");
    add(rest.substr(0, serial));
    if (serial != std::string_view::npos) add(rest.substr(serial + 4));
    return aliases;
  }

  void ReadRow() {
    reader_.Split(',');
    reader_.DropEmptyEnd(1);
    CheckReadings(recording_.rows, recording_.markers.size() + blocks_.size(), reader_.Where());
    for (RecordedBody& body : recording_.bodies) body.poses.emplace_back();
    for (RecordedMarker& marker : recording_.markers) marker.points.emplace_back();
    std::vector<bool> is_read(blocks_.size(), false);
    std::optional<std::int64_t> time;
    std::optional<double> frame;
    std::size_t column = 1;
    long tools = 0;
    for (; column < reader_.size(); ++tools) {
      const std::size_t b = FindBlock(column);
      const Block& block = blocks_[b];
      if (is_read[b])
        throw InputError(reader_.At(column), "the same tool twice in a row", "each tool once");
      is_read[b] = true;
      RequireCells(column, block);
      if (!time && block.Has("time [sec]"))
        time = reader_.Seconds(column + block.columns.at("time [sec]"));
      if (!frame && block.Has("frame"))
        frame = ParseDouble(reader_.Text(column + block.columns.at("frame")));
      ReadTool(column, block, recording_.bodies[b]);
      column += block.width;
    }
    if (reader_.Number(0) != static_cast<double>(tools))
      throw InputError(reader_.At(0),
                       fmt::format("Tools = {}", reader_.Text(0)),
                       fmt::format("{}, as many as there are in the row", tools));
    if (time) recording_.times.push_back(*time);
    if (frame) recording_.frames.push_back(*frame);
    recording_.lines.push_back(reader_.LineNumber());
    ++recording_.rows;
    if (!recording_.times.empty() && recording_.times.size() != recording_.rows)
      throw InputError(reader_.Where(), "no time", "a time in every row, or in none");
  }

  // Tools that left the tracker have no block in a row.
  std::size_t FindBlock(std::size_t column) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      if (blocks_[b].port == reader_.Text(column)) return b;
    throw InputError(
        reader_.At(column), Quoted(reader_.Text(column)), "a tool that the header has");
  }

  // Empty cells at the end were dropped: markers that are not there may be such.
  void RequireCells(std::size_t column, const Block& block) const {
    if (column + block.width <= reader_.size()) return;
    throw InputError(
        reader_.At(reader_.size()),
        fmt::format(
            "a row that ends after {} cells of {}", reader_.size() - column, Quoted(block.port)),
        fmt::format("{} cells", block.width));
  }

  void ReadTool(std::size_t begin, const Block& block, RecordedBody& body) {
    const auto at = [&](const char* name) { return begin + block.columns.at(name); };
    const std::string_view state = reader_.Text(at("state"));
    if (LowerCase(state) != kOk) {
      if (not_ok_.size() < kMostStates || not_ok_.count(std::string(state)) > 0)
        ++not_ok_[std::string(state)];
      return;
    }
    const std::optional<Eigen::Vector3d> translation =
        reader_.Point(at("tx"), kMillimetre, std::nullopt);
    if (translation) {
      const Eigen::Vector4d wxyz(reader_.Number(at("q0")),
                                 reader_.Number(at("qx")),
                                 reader_.Number(at("qy")),
                                 reader_.Number(at("qz")));
      body.poses.back() = Pose3d{*translation, CheckedQuaternion(wxyz, reader_.At(at("q0")))};
    }
    for (std::size_t k = 0; k < block.groups; ++k) {
      const std::size_t group = begin + block.first_group + kGroupSize * k;
      if (LowerCase(reader_.Text(group)) != kOk) continue;
      recording_.markers[static_cast<std::size_t>(body.markers[k])].points.back() =
          reader_.Point(group + 1, kMillimetre, missing_value_);
    }
  }

  static constexpr std::size_t kMostStates = 8;

  DelimitedReader reader_;
  std::optional<double> missing_value_;
  Recording recording_;
  std::vector<Block> blocks_;
  std::map<std::string, int> not_ok_;  // rows by what their state was
};

}  // namespace

Recording ReadNdiCsv(const std::string& path, const ImportOptions& options) {
  return NdiCsv(path, options).Read();
}

}  // namespace hexcal
