// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "config/input_error.h"
#include "config/utf8.h"
#include "fuzz/readers.h"

namespace hexcal::fuzz {
namespace {

constexpr std::size_t kLongestMessage = 4000;

void Write(const std::string& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace

void WriteCompanions(const std::string& folder) {
  for (const char* inside : {"/chunks", "/poses"})
    std::filesystem::create_directories(folder + inside);
  Write(folder + "/dataset.yaml", R"(format: hexcal/dataset/1
name: small
units: {length: mm, angle: deg}
robot_poses: {file: poses.csv}
tracker: {static: false}
measurement:
  kind: markers
  file: markers.csv
  noise: {sigma: 0.03}
  bodies:
    base: {frame: rigid, markers: {b1: [0, 0, 0], b2: [100, 0, 0], b3: [0, 80, 0]}}
    tool: {frame: rigid, markers: {t1: [0, 0, 0], t2: [50, 0, 0], t3: [0, 40, 0]}}
)");
  Write(folder + "/model.yaml", R"(format: hexcal/model/1
dataset: small
world_from_base: {xyz: [0, 0, 0], rpy: [0, 0, 0]}
platform_from_tool: {xyz: [1, 2, 0], rpy: [0, 0, 0]}
)");
  Write(folder + "/poses.csv",
        "pose,x,y,z,rx,ry,rz\n1,0,0,200,0,0,0\n2,5,-5,210,1,2,3\n3,-5,5,210,3,2,1\n"
        "4,1,5,190,-3,2,-1\n");
  std::string markers = "pose,body,marker,x,y,z\n";
  for (const char* pose : {"1", "2", "3", "4"})
    for (const char* rest : {"base,b1,0,0,0",
                             "base,b2,100,0,0",
                             "base,b3,0,80,0",
                             "tool,t1,1,2,200",
                             "tool,t2,51,2,200",
                             "tool,t3,1,42,200"})
      markers += std::string(pose) + "," + rest + "\n";
  Write(folder + "/markers.csv", markers);
  Write(folder + "/list.yaml", "data:\n  - {pose: poses/0.yaml}\n");
  Write(folder + "/poses/0.yaml", "{x: 1, y: 2, z: 3, qx: 0, qy: 0, qz: 0, qw: 1}\n");
}

// A message goes to terminals and logs: no control characters, and not the whole input again.
void CheckMessage(std::string_view message) {
  if (!message.empty() && message.size() <= kLongestMessage && !HasControls(message)) return;
  std::fprintf(stderr, "not a message: %zu bytes\n", message.size());
  std::abort();
}

bool Meet(const Reader& reader, const std::string& folder, std::string_view bytes) {
  const std::string path = folder + "/" + reader.file;
  Write(path, bytes);
  try {
    reader.read(folder, path, reader);
    return true;
  } catch (const InputError& error) {
    CheckMessage(error.what());
    return false;
  }
}

}  // namespace hexcal::fuzz
