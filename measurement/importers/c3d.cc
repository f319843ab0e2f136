// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/c3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/input_file.h"
#include "config/utf8.h"
#include "measurement/importers/c3d_parameters.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/little_endian.h"
#include "measurement/importers/missing.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr unsigned char kMark = 0x50;
constexpr std::size_t kUnknownLast = 65535;  // more frames than the header can say

class C3d {
 public:
  C3d(const std::string& path, const ImportOptions& options)
      : file_(FileLocation(path)),
        missing_value_(options.missing_value),
        bytes_(ReadTextFile(path, kMostImportBytes)) {
    recording_.path = path;
  }

  Recording Read() {
    ReadHeader();
    parameters_ = ReadC3dParameters(bytes_, static_cast<unsigned char>(bytes_[0]), file_);
    ReadUnits();
    CheckPoints();
    NamePoints();
    CheckSize();
    CheckFrames();
    for (std::size_t frame = 0; frame < frames_; ++frame) ReadFrame(frame);
    WarnOfZeros(recording_);
    recording_.reading = unit_;
    return std::move(recording_);
  }

 private:
  std::size_t Word(std::size_t number) const { return Uint16At(bytes_, 2 * (number - 1)); }

  void ReadHeader() {
    if (bytes_.size() < kC3dBlock || static_cast<unsigned char>(bytes_[1]) != kMark)
      RefuseC3d(file_, 0, "no C3D header", "a C3D file: 512 bytes of header, its second 0x50");
    points_ = Word(2);
    analog_ = Word(3);
    first_ = Word(4);
    last_ = Word(5);
    scale_ = FloatAt(bytes_, 12);
    data_begin_ = (std::max<std::size_t>(Word(9), 1) - 1) * kC3dBlock;
    rate_ = FloatAt(bytes_, 20);
    if (points_ == 0) RefuseC3d(file_, 2, "no points", "the points of markers");
    if (!std::isfinite(scale_) || scale_ == 0.0f)
      RefuseC3d(file_, 12, fmt::format("the scale {}", scale_), "a number other than 0");
    if (!(rate_ > 0.0f) || !std::isfinite(rate_))
      RefuseC3d(file_, 20, fmt::format("the frame rate {}", rate_), "frames a second");
    if (last_ < first_)
      RefuseC3d(file_, 6, fmt::format("frames {} to {}", first_, last_), "a first and a last");
    value_size_ = scale_ < 0.0f ? 4 : 2;
  }

  const C3dParameter* Find(const std::string& name) const {
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? nullptr : &found->second;
  }

  void ReadUnits() {
    const C3dParameter* units = Find("POINT:UNITS");
    const std::vector<std::string> texts =
        units == nullptr ? std::vector<std::string>{} : C3dTexts(*units);
    const std::string unit = texts.empty() ? "" : LowerCase(Trimmed(texts[0]));
    metres_ = unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : unit == "m" ? 1.0 : 0.0;
    if (metres_ == 0.0)
      throw InputError(file_, fmt::format("POINT:UNITS {}", Quoted(unit)), "mm, cm or m");
    unit_ = unit;
  }

  // What the header says of the size stands among the parameters, too.
  std::optional<std::size_t> Count(const std::string& name) const {
    const C3dParameter* parameter = Find(name);
    return parameter == nullptr ? std::nullopt : C3dCount(*parameter);
  }

  void CheckPoints() const {
    const std::optional<std::size_t> used = Count("POINT:USED");
    if (used && *used != points_)
      RefuseC3d(file_,
                2,
                fmt::format("{} points in the header, {} in POINT:USED", points_, *used),
                "the same number: else no place in the file is sure");
  }

  void CheckFrames() {
    const std::optional<std::size_t> stated = Count("POINT:FRAMES");
    if (stated && *stated != kUnknownLast && *stated != frames_)
      recording_.warnings.push_back(
          fmt::format("{}: {} frames by its header, where POINT:FRAMES says {}; as many as the "
                      "header says are used",
                      recording_.path,
                      frames_,
                      *stated));
  }

  // Labels as far as they are text, else numbers.
  void NamePoints() {
    std::vector<std::string> labels;
    for (const char* name : {"POINT:LABELS", "POINT:LABELS2", "POINT:LABELS3"})
      if (const C3dParameter* parameter = Find(name))
        for (std::string& text : C3dTexts(*parameter)) labels.push_back(std::move(text));
    if (!labels.empty() && labels.size() < points_)
      recording_.warnings.push_back(
          fmt::format("{}: {} points, of which POINT:LABELS names {}; the others go by their "
                      "numbers, 'point {}' on",
                      recording_.path,
                      points_,
                      labels.size(),
                      labels.size() + 1));
    for (std::size_t p = 0; p < points_; ++p) {
      std::string name = p < labels.size() ? labels[p] : "";
      const bool is_text =
          std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; });
      recording_.markers.push_back(
          {name.empty() || !is_text ? fmt::format("point {}", p + 1) : std::move(name), {}});
    }
  }

  void CheckSize() {
    frame_size_ = value_size_ * (4 * points_ + analog_);
    if (data_begin_ < kC3dBlock || data_begin_ >= bytes_.size())
      RefuseC3d(file_, 16, fmt::format("data from byte {} on", data_begin_), "data in the file");
    const std::size_t there = (bytes_.size() - data_begin_) / frame_size_;
    frames_ = last_ == kUnknownLast ? there : last_ - first_ + 1;
    if (there < frames_ || frames_ == 0)
      RefuseC3d(file_,
                bytes_.size(),
                fmt::format("the end of the file after {} frames", there),
                fmt::format("{} frames, as its header says", frames_));
    CheckReadings(frames_, points_, file_);
  }

  double Value(std::size_t at) const {
    if (value_size_ == 4) return static_cast<double>(FloatAt(bytes_, at));
    return static_cast<double>(static_cast<std::int16_t>(Uint16At(bytes_, at)));
  }

  void ReadFrame(std::size_t frame) {
    const double scale = scale_ < 0.0f ? 1.0 : static_cast<double>(scale_);  // units of the file
    for (std::size_t p = 0; p < points_; ++p) {
      const std::size_t at = data_begin_ + frame * frame_size_ + 4 * value_size_ * p;
      recording_.markers[p].points.push_back(ReadPoint(at, scale));
    }
    const std::optional<std::int64_t> time =
        Nanoseconds(static_cast<double>(first_ + frame) / static_cast<double>(rate_));
    if (!time) RefuseC3d(file_, 20, fmt::format("the frame rate {}", rate_), "frames a second");
    recording_.times.push_back(*time);
    ++recording_.rows;
  }

  std::optional<Eigen::Vector3d> ReadPoint(std::size_t at, double scale) const {
    const Eigen::Vector3d stored(Value(at), Value(at + value_size_), Value(at + 2 * value_size_));
    const double residual = Value(at + 3 * value_size_);
    if (!(residual >= 0.0) ||
        std::any_of(stored.begin(), stored.end(), [](double value) { return IsMissing(value); }))
      return std::nullopt;
    if (!stored.allFinite()) RefuseC3d(file_, at, "an infinite coordinate", "a number");
    const Eigen::Vector3d point = scale * stored;
    if (missing_value_ && (point.array() == *missing_value_).all()) return std::nullopt;
    return metres_ * point;
  }

  Location file_;
  std::optional<double> missing_value_;
  std::string bytes_;
  Recording recording_;
  C3dParameters parameters_;
  std::size_t points_ = 0, analog_ = 0, first_ = 0, last_ = 0, frames_ = 0;
  std::size_t data_begin_ = 0, value_size_ = 2, frame_size_ = 0;  // bytes
  float scale_ = 0.0f, rate_ = 0.0f;
  double metres_ = 0.0;  // per unit
  std::string unit_;
};

}  // namespace

Recording ReadC3d(const std::string& path, const ImportOptions& options) {
  return C3d(path, options).Read();
}

}  // namespace hexcal
