// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "config/number.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/ndi_bodies.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr long kMostMarkers = 256;
constexpr const char* kHeader =
    "an NDI marker description (.rig): 'Marker Description File', 'Real 3D', '4 ;Number of "
    "markers', then a table 'Marker X Y Z Views'";

// The next line that is not empty.
void RequireLine(DelimitedReader& reader, std::string_view expected) {
  while (reader.Next())
    if (!Trimmed(reader.Line()).empty()) return;
  throw InputError(reader.File(), "the end of the file", expected);
}

long ReadCount(DelimitedReader& reader) {
  RequireLine(reader, kHeader);
  const std::string_view line = reader.Line();
  const std::optional<long> count = ParseInteger(Trimmed(line.substr(0, line.find(';'))));
  if (count && *count >= 3 && *count <= kMostMarkers) return *count;
  throw InputError(reader.Where(),
                   Quoted(Trimmed(line)),
                   fmt::format("a number of markers, 3 to {}", kMostMarkers));
}

bool IsTable(const DelimitedReader& reader) {
  return reader.size() >= 4 && LowerCase(reader.Text(0)) == "marker" &&
         LowerCase(reader.Text(1)) == "x" && LowerCase(reader.Text(2)) == "y" &&
         LowerCase(reader.Text(3)) == "z";
}

}  // namespace

StatedShape ReadRig(const std::string& path) {
  DelimitedReader reader(path);
  RequireLine(reader, kHeader);
  if (LowerCase(Trimmed(reader.Line())) != "marker description file")
    throw InputError(reader.Where(), Quoted(Trimmed(reader.Line())), kHeader);
  RequireLine(reader, kHeader);
  if (LowerCase(Trimmed(reader.Line())) != "real 3d")
    throw InputError(reader.Where(), Quoted(Trimmed(reader.Line())), "'Real 3D'");
  const long count = ReadCount(reader);
  do {
    RequireLine(reader, "a table 'Marker X Y Z Views'");
    reader.Split(' ');
  } while (!IsTable(reader));

  StatedShape shape{path, {}, Eigen::Matrix3Xd(3, count)};
  for (long m = 0; m < count; ++m) {
    RequireLine(reader, fmt::format("{} markers in the table", count));
    reader.Split(' ');
    if (reader.size() < 4)
      throw InputError(reader.Where(),
                       fmt::format("{} cells", reader.size()),
                       "a marker: its number, x, y, z and the views it is in");
    const std::string name(reader.Text(0));
    if (std::find(shape.names.begin(), shape.names.end(), name) != shape.names.end())
      throw InputError(
          reader.At(0), fmt::format("marker {} a second time", Quoted(name)), "each once");
    shape.names.push_back(name);
    const std::optional<Eigen::Vector3d> point = reader.Point(1, kMillimetre, std::nullopt);
    if (!point) throw InputError(reader.At(1), "no coordinates", "those of a marker, mm");
    shape.points.col(m) = *point;
  }
  return shape;
}

}  // namespace hexcal
