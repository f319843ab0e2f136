// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/first_principles.h"

#include <fmt/format.h>

#include "config/number.h"
#include "config/units.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr int kMostPreamble = 32;
constexpr const char* kHeader =
    "an NDI First Principles text: 'Number of frames: N', 'Frequency: Hz', 'Units: mm', an empty "
    "line, then the columns Frame, NAME x, NAME y, NAME z, ...";

class FirstPrinciples {
 public:
  FirstPrinciples(const std::string& path, const ImportOptions& options)
      : reader_(path), missing_value_(options.missing_value) {
    recording_.path = path;
  }

  Recording Read() {
    ReadPreamble();
    ReadColumns();
    while (reader_.Next()) {
      if (!Trimmed(reader_.Line()).empty()) ReadRow();
    }
    if (static_cast<long>(recording_.rows) < frames_)
      throw InputError(reader_.File(),
                       fmt::format("{} rows", recording_.rows),
                       fmt::format("{}, as its 'Number of frames' says: is it cut off?", frames_));
    if (static_cast<long>(recording_.rows) > frames_)
      recording_.warnings.push_back(
          fmt::format("{}: {} rows, where 'Number of frames' says {}; all are used",
                      recording_.path,
                      recording_.rows,
                      frames_));
    WarnOfZeros(recording_);
    recording_.reading = fmt::format("{}, empty cells not seen", unit_);
    return std::move(recording_);
  }

 private:
  bool IsColumns() const { return LowerCase(Trimmed(reader_.Line()).substr(0, 5)) == "frame"; }

  void ReadPreamble() {
    for (int lines = 0; lines < kMostPreamble; ++lines) {
      if (!reader_.Next()) throw InputError(reader_.File(), "the end of the file", kHeader);
      if (IsColumns()) break;
      std::string_view line = Trimmed(reader_.Line());
      while (!line.empty() && (line.back() == ',' || line.back() == '\t')) line.remove_suffix(1);
      const std::size_t colon = line.find(':');
      if (!line.empty() && colon == std::string_view::npos)
        throw InputError(reader_.Where(), Quoted(line), kHeader);
      if (!line.empty())
        ReadEntry(LowerCase(Trimmed(line.substr(0, colon))), Trimmed(line.substr(colon + 1)));
    }
    const char* lacking = !IsColumns()          ? "a line of columns 'Frame'"
                          : frames_ < 0         ? "'Number of frames'"
                          : !(frequency_ > 0.0) ? "'Frequency'"
                          : unit_.empty()       ? "'Units'"
                                                : nullptr;
    if (lacking != nullptr)
      throw InputError(reader_.Where(), fmt::format("no {}", lacking), kHeader);
  }

  void ReadEntry(const std::string& key, std::string_view value) {
    if (key == "number of frames") {
      const std::optional<long> frames = ParseInteger(value);
      if (!frames || *frames < 1)
        throw InputError(reader_.Where(), Quoted(value), "a number of frames");
      frames_ = *frames;
    } else if (key == "frequency") {
      const std::optional<double> frequency = ParseDouble(value);
      if (!frequency || !(*frequency > 1e-6) || !(*frequency < 1e7))
        throw InputError(reader_.Where(), Quoted(value), "a frequency in Hz");
      frequency_ = *frequency;
    } else if (key == "units") {
      const std::optional<Unit> unit = FindLengthUnit(value);
      if (!unit) throw InputError(reader_.Where(), Quoted(value), "the units mm or m");
      unit_ = unit->symbol;
      scale_ = unit->factor;
    }
  }

  // "Beam1 x", "Beam1 y", "Beam1 z"
  void ReadColumns() {
    delimiter_ = reader_.Line().find('\t') != std::string_view::npos ? '\t' : ',';
    reader_.Split(delimiter_);
    reader_.DropEmptyEnd(1);
    const std::size_t count = reader_.size() - 1;
    if (count == 0 || count % 3 != 0)
      throw InputError(reader_.Where(),
                       fmt::format("{} columns beside 'Frame'", count),
                       "three for each marker, NAME x, NAME y, NAME z; a file of 6D data goes by a "
                       "column map (format columns)");
    for (std::size_t i = 1; i < reader_.size(); i += 3) {
      const std::string_view first = reader_.Text(i);
      const std::string name(Trimmed(first.substr(0, first.size() - (first.empty() ? 0 : 1))));
      for (std::size_t k = 0; k < 3; ++k)
        if (LowerCase(reader_.Text(i + k)) != LowerCase(name) + ' ' + "xyz"[k])
          throw InputError(reader_.At(i + k),
                           fmt::format("the column {}", Quoted(reader_.Text(i + k))),
                           fmt::format("'{} {}'; a file of 6D data goes by a column map (format "
                                       "columns)",
                                       name.empty() ? "NAME" : name,
                                       "xyz"[k]));
      recording_.markers.push_back({name, {}});
    }
  }

  void ReadRow() {
    const std::size_t columns = 1 + 3 * recording_.markers.size();
    reader_.Split(delimiter_);
    reader_.DropEmptyEnd(columns);
    reader_.RequireSize(columns, "one for each column");
    CheckReadings(recording_.rows, recording_.markers.size(), reader_.Where());
    const std::optional<std::int64_t> time = Nanoseconds(reader_.Number(0) / frequency_);
    if (!time) throw InputError(reader_.At(0), Quoted(reader_.Text(0)), "the number of a frame");
    recording_.times.push_back(*time);
    recording_.frames.push_back(reader_.Number(0));
    for (std::size_t m = 0; m < recording_.markers.size(); ++m)
      recording_.markers[m].points.push_back(reader_.Point(1 + 3 * m, scale_, missing_value_));
    recording_.lines.push_back(reader_.LineNumber());
    ++recording_.rows;
  }

  DelimitedReader reader_;
  std::optional<double> missing_value_;
  Recording recording_;
  long frames_ = -1;
  double frequency_ = 0.0;  // Hz
  std::string unit_;
  double scale_ = 1.0;  // m per unit
  char delimiter_ = '\t';
};

}  // namespace

Recording ReadFirstPrinciples(const std::string& path, const ImportOptions& options) {
  return FirstPrinciples(path, options).Read();
}

}  // namespace hexcal
