// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/input_file.h"
#include "config/utf8.h"
#include "measurement/importers/c3d.h"
#include "measurement/importers/columns.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/first_principles.h"
#include "measurement/importers/motive.h"
#include "measurement/importers/ndi_bodies.h"
#include "measurement/importers/ndi_csv.h"
#include "measurement/importers/pi_gcs.h"
#include "measurement/importers/trajectories.h"
#include "measurement/importers/yaml_poses.h"

namespace hexcal {
namespace {

constexpr std::size_t kBeginning = 512;

bool BeginsWith(std::string_view text, std::string_view word) {
  return LowerCase(text.substr(0, word.size())) == word;
}

bool IsNdiCsv(std::string_view text) { return BeginsWith(text, "tools,"); }

bool IsPiGcs(std::string_view text) {
  return !text.empty() && text.front() == '#' && text.find("TYPE") < text.find('\n');
}

bool IsFirstPrinciples(std::string_view text) { return BeginsWith(text, "number of frames"); }

bool IsMotive(std::string_view text) { return BeginsWith(text, "format version,"); }

bool IsC3d(std::string_view text) {
  return text.size() >= kBeginning && text[0] >= 2 && text[1] == 0x50;
}

bool IsEuroc(std::string_view text) { return BeginsWith(text, "#timestamp"); }

bool IsRom(std::string_view text) { return text.substr(0, 4) == std::string_view("NDI\0", 4); }

bool IsRig(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos &&
         BeginsWith(text.substr(begin), "marker description file");
}

bool IsEasyHandeye(std::string_view text) {
  return BeginsWith(text, "parameters:") || text.find("\ntransformation:") < text.size();
}

bool IsIndustrialCalibration(std::string_view text) {
  return BeginsWith(text, "data:") || text.find("\ndata:") < text.size();
}

std::string Beginning(const std::string& path) {
  InputFile file(path, kMostImportBytes);
  std::string text(kBeginning, '\0');
  std::size_t size = 0;
  while (size < text.size()) {
    const std::size_t count = file.Read(text.data() + size, text.size() - size);
    if (count == 0) break;
    size += count;
  }
  text.resize(size);
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.erase(0, kByteOrderMark.size());
  return text;
}

std::string NamesWhere(bool (*holds)(const ImportFormat&)) {
  std::string names;
  for (const ImportFormat& format : ImportFormats())
    if (holds(format)) names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
  return names;
}

}  // namespace

const std::vector<ImportFormat>& ImportFormats() {
  static const std::vector<ImportFormat> formats = {
      {"ndi_csv",
       "NDI Polaris sample program or Track, wide CSV: poses and markers of tools",
       false,
       &IsNdiCsv,
       &ReadNdiCsv},
      {"first_principles",
       "NDI First Principles, 3D data as text: markers",
       false,
       &IsFirstPrinciples,
       &ReadFirstPrinciples},
      {"motive",
       "OptiTrack Motive, CSV: markers and poses of rigid bodies",
       false,
       &IsMotive,
       &ReadMotive},
      {"c3d", "C3D, binary, Intel byte order: markers", false, &IsC3d, &ReadC3d},
      {"tum", "TUM trajectory: poses over time", false, &IsTum, &ReadTum},
      {"euroc", "EuRoC trajectory, CSV: poses over time", false, &IsEuroc, &ReadEuroc},
      {"pi_gcs",
       "Physik Instrumente GCS array: the poses of a hexapod",
       true,
       &IsPiGcs,
       &ReadPiGcs},
      {"industrial_calibration",
       "industrial_calibration, YAML list of files of poses",
       false,
       &IsIndustrialCalibration,
       &ReadIndustrialCalibration},
      {"columns",
       "Any table, by a column map (--map, --robot_map)",
       false,
       nullptr,
       &ReadColumnsFile},
      {"rig",
       "NDI marker description, text: a body, for --base_body and --tool_body",
       false,
       &IsRig,
       nullptr,
       &ReadRig},
      {"rom",
       "NDI tool definition, binary: a body, for --base_body and --tool_body",
       false,
       &IsRom,
       nullptr,
       &ReadRom},
      {"easy_handeye",
       "easy_handeye calibration, YAML: a first guess, for --initial",
       false,
       &IsEasyHandeye,
       nullptr,
       nullptr,
       &ReadEasyHandeye},
  };
  return formats;
}

const ImportFormat* FindImportFormat(std::string_view name) {
  const std::vector<ImportFormat>& formats = ImportFormats();
  const auto found = std::find_if(
      formats.begin(), formats.end(), [name](const ImportFormat& f) { return f.name == name; });
  return found == formats.end() ? nullptr : &*found;
}

const ImportFormat* RecogniseFormat(const std::string& path) {
  const std::string beginning = Beginning(path);
  if (const std::string two = beginning.substr(0, 2); two == "\xFF\xFE" || two == "\xFE\xFF")
    RefuseBadText(two, {FileLocation(path).file, 1, 1});  // Excel's "Unicode text"
  for (const ImportFormat& format : ImportFormats())
    if (format.recognise != nullptr && format.recognise(beginning)) return &format;
  return nullptr;
}

Recording ReadRecording(const ImportFormat& format,
                        const std::string& path,
                        const ImportOptions& options) {
  try {
    return format.read_recording(path, options);
  } catch (const InputError& error) {
    const ImportFormat* other = RecogniseFormat(path);
    if (other == nullptr || other == &format || format.recognise == nullptr) throw;
    throw InputError(
        fmt::format("{} (the file begins like one of the format {})", error.what(), other->name));
  }
}

StatedShape ReadStatedShape(const std::string& path) {
  const ImportFormat* format = RecogniseFormat(path);
  if (format != nullptr && format->read_shape != nullptr) return format->read_shape(path);
  throw InputError(FileLocation(path),
                   format == nullptr ? "a file of no known kind"
                                     : fmt::format("a file of the format {}", format->name),
                   "a marker body: " +
                       NamesWhere([](const ImportFormat& f) { return f.read_shape != nullptr; }));
}

}  // namespace hexcal
