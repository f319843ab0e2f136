// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/readers.h"
#include "measurement/dataset.h"
#include "measurement/importers/column_map.h"
#include "measurement/importers/formats.h"
#include "measurement/importers/hexapod_file.h"
#include "measurement/pivoting.h"
#include "measurement/tool_pose.h"
#include "model/machine.h"
#include "model/predict.h"

namespace hexcal::fuzz {
namespace {

// As every command begins: read, poses of the robot, poses of the tool.
void ReadAll(const std::string& dataset_path) {
  const Dataset dataset = ReadDataset(dataset_path, false);
  ReportedPoses(dataset);
  if (dataset.measurement) ComputeToolPoses(dataset);
}

void ReadWhole(const std::string&, const std::string& path, const Reader&) { ReadAll(path); }

void ReadTable(const std::string& folder, const std::string&, const Reader&) {
  ReadAll(folder + "/dataset.yaml");
}

void ReadModel(const std::string&, const std::string& path, const Reader&) {
  WriteMachine(ReadMachine(path));
}

void ReadTip(const std::string&, const std::string& path, const Reader&) { ReadPivoting(path); }

void ReadHexapod(const std::string&, const std::string& path, const Reader&) {
  ReadHexapodFile(path);
}

void ReadMap(const std::string&, const std::string& path, const Reader&) { ReadColumnMap(path); }

void ReadImport(const std::string&, const std::string& path, const Reader& self) {
  const ImportFormat& format = *FindImportFormat(self.name.substr(std::string("import_").size()));
  RecogniseFormat(path);
  if (format.read_recording != nullptr) ReadRecording(format, path, {});
  if (format.read_shape != nullptr) format.read_shape(path);
  if (format.read_transform != nullptr) format.read_transform(path);
}

// Of industrial_calibration, which names them in a list.
void ReadPoseFile(const std::string& folder, const std::string&, const Reader&) {
  ReadRecording(*FindImportFormat("industrial_calibration"), folder + "/list.yaml", {});
}

}  // namespace

std::vector<Reader> DataReaders() {
  std::vector<Reader> readers = {{"dataset", "fuzzed.yaml", &ReadWhole},
                                 {"robot_poses", "poses.csv", &ReadTable},
                                 {"markers", "markers.csv", &ReadTable},
                                 {"model", "fuzzed.yaml", &ReadModel},
                                 {"pivoting", "fuzzed.yaml", &ReadTip},
                                 {"hexapod", "fuzzed.yaml", &ReadHexapod},
                                 {"column_map", "fuzzed.yaml", &ReadMap},
                                 {"pose_file", "poses/0.yaml", &ReadPoseFile}};
  for (const ImportFormat& format : ImportFormats())
    if (format.name != "columns")  // its table is read by a map, as robot_poses is
      readers.push_back({"import_" + std::string(format.name), "fuzzed", &ReadImport});
  return readers;
}

}  // namespace hexcal::fuzz
