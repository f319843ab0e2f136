// SPDX-License-Identifier: BSD-3-Clause
#include "testing/schema_samples.h"

#include "measurement/dataset.h"
#include "model/data_fault.h"
#include "model/effect.h"
#include "model/machine.h"

namespace hexcal::testing {
namespace {

constexpr const char* kMarkers = R"(format: hexcal/dataset/1
name: bench
description: by markers
units: {length: mm, angle: deg}
covariates: {time: s, temperature: degC, payload: kg, payload_x: mm, vx: mm/s, wz: deg/s, direction_1: 1, humidity: 1}
gravity: [0, 0, -1]
hexapod:
  base_joints: [[100, 0, 0], [50, 87, 0], [-50, 87, 0], [-100, 0, 0], [-50, -87, 0], [50, -87, 0]]
  platform_joints: [[60, 10, 0], [20, 57, 0], [-40, 47, 0], [-60, -10, 0], [-20, -57, 0], [40, -47, 0]]
  base_axes: [[1, 0, 0], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
  platform_axes: [[1, 0, 0], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
  leg_limits: [100, 400]
  home: [0, 0, 200, 0, 0, 0]
reference_temperature: 20
robot_poses:
  file: poses.csv
  noise: {position: 0.002, orientation: [0.0001, 0.0001, 0.0002]}
tracker:
  static: true
  pose: {xyz: [0, 0, 2000], quaternion: [1, 0, 0, 0]}
  frames: 5
measurement:
  kind: markers
  noise: {sigma: [0.1, 0.1, 0.2]}
  bodies:
    base: {frame: rigid, markers: {b1: [0, 0, 0], b2: [200, 0, 0], b3: [0, 150, 0]}}
    tool: {frame: centroid, markers: [t1, t2, t3], x_axis: [t1, t2]}
initial:
  base: {xyz: [0, 0, 0], rpy: [0, 0, 0]}
  tool: {xyz: [0, 0, 0], quaternion: [1, 0, 0, 0]}
)";

constexpr const char* kPoses = R"(format: hexcal/dataset/1
name: bench-2
units: {length: m, angle: rad}
hexapod:
  base_joints: [[0.1, 0, 0], [0.05, 0.087, 0], [-0.05, 0.087, 0], [-0.1, 0, 0], [-0.05, -0.087, 0], [0.05, -0.087, 0]]
  platform_joints: [[0.06, 0.01, 0], [0.02, 0.057, 0], [-0.04, 0.047, 0], [-0.06, -0.01, 0], [-0.02, -0.057, 0], [0.04, -0.047, 0]]
  home: {xyz: [0, 0, 0.2], quaternion: [1, 0, 0, 0]}
robot_poses:
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [1, 0, 0, 0.1, 0, 0, 0]
    - [2, 0, 0.01, 0.1, 0, 0.1, 0]
    - [3, 0.01, 0, 0.1, 0.1, 0, 0]
measurement:
  kind: poses
  file: measured.csv
  noise: {position: [0.001, 0.001, 0.002], orientation: 0.0005}
)";

constexpr const char* kLegs = R"(format: hexcal/dataset/1
name: legs
units: {length: mm, angle: rad}
hexapod:
  base_joints: [[100, 0, 0], [50, 87, 0], [-50, 87, 0], [-100, 0, 0], [-50, -87, 0], [50, -87, 0]]
  platform_joints: [[60, 10, 0], [20, 57, 0], [-40, 47, 0], [-60, -10, 0], [-20, -57, 0], [40, -47, 0]]
robot_poses: {file: legs.csv, noise: {leg: 0.002}}
measurement:
  kind: poses
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [1, 0, 0, 0.1, 0, 0, 0]
    - [2, 0, 0.01, 0.1, 0, 0.1, 0]
    - [3, 0.01, 0, 0.1, 0.1, 0, 0]
)";

constexpr const char* kRequirement = R"(format: hexcal/requirement/1
units: {length: mm, angle: deg}
identification: {hexapod: serial 12}
points: [{name: tip, xyz: [0, 0, 100], standard_deviation: 0.02}]
workspace: {x: [-20, 20], y: [-20, 20], z: [180, 220], rx: [-5, 5], ry: [-5, 5], rz: [-5, 5]}
robot: {position: 0.01, orientation: 0.001, distribution: uniform, degrees_of_freedom: 50, from: the maker}
sources:
  - {name: heat, at: platform, position: 0.01, orientation: 0.001, distribution: normal, degrees_of_freedom: 9, from: a guess}
  - {name: wear, at: point, position: 0.01, from: a guess}
requirements:
  - {name: drilling, point: tip, over: workspace, limit: 0.5, probability: 0.95}
)";

constexpr const char* kColumns = R"(format: hexcal/columns/1
delimiter: semicolon
decimal_comma: true
skip: 2
header: true
comment: "#"
units: {length: mm, angle: deg}
missing: -9999
time: {column: Seconds, unit: ms}
label: Sample
bodies:
  probe: {position: [Xa, Ya, Za], quaternion: [qoa, qxa, qya, qza], markers: [M1]}
  robot: {position: [3, 4, 5], angles: [U, V, W], order: zyx}
  other: {position: [3, 4, 5], matrix: [a, b, c, d, e, f, g, h, i]}
markers:
  M1: [M1x, M1y, M1z]
)";

constexpr const char* kPivotingMarkers = R"(format: hexcal/pivoting/1
name: probe
description: about its tip
units: {length: mm, angle: deg}
tracker: {static: true}
measurement:
  kind: markers
  file: pivoting.csv
  noise: {sigma: 0.1}
  bodies:
    base: {frame: rigid, markers: {b1: [0, 0, 0], b2: [200, 0, 0], b3: [0, 150, 0]}}
    tool: {frame: centroid, markers: [t1, t2, t3], x_axis: [t1, t2]}
)";

constexpr const char* kPivotingPoses = R"(format: hexcal/pivoting/1
name: probe
units: {length: m, angle: rad}
measurement:
  kind: poses
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [1, 0, 0, 0.1, 0, 0, 0]
    - [2, 0, 0.01, 0.1, 0, 0.1, 0]
    - [3, 0.01, 0, 0.1, 0.1, 0, 0]
  noise: {position: 0.001, orientation: 0.001}
)";

constexpr const char* kStudy = R"(format: hexcal/batch/1
name: desk-top
study:
  draws: 10
  seed: 1
  records: 6
  scenarios:
    - {name: sixty, dataset: plan.yaml, truth: truth.yaml, test: plan.yaml, noise: [0.5, 1], poses: [3], effects: [0, 1],
       noise_known: true}
estimators:
  - {name: mine, method: nonlinear, settings: {iterations: 30}}
  - {name: what, method: discover, settings: {bootstraps: 199}}
  - shah
)";

constexpr const char* kModelHead = R"(format: hexcal/model/1
dataset: bench
world_from_base: {xyz: [0.3, -0.2, 0.1], quaternion: [1, 0, 0, 0]}
platform_from_tool: {xyz: [0, 0, 0.05], rpy: [0, 0, 0.1]}
)";

constexpr const char* kModelTail = R"(world_from_tracker: {xyz: [0, 0, 2], quaternion: [0, 1, 0, 0]}
hexapod:
  base_joints: [[100, 0, 0], [50, 87, 0], [-50, 87, 0], [-100, 0, 0], [-50, -87, 0], [50, -87, 0]]
  platform_joints: [[60, 10, 0], [20, 57, 0], [-40, 47, 0], [-60, -10, 0], [-20, -57, 0], [40, -47, 0]]
  base_axes: [[1, 0, 0], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
  platform_axes: [[1, 0, 0], [0, 1, 0], [0, 1, 0], [1, 0, 0], [0, 1, 0], [0, 1, 0]]
  leg_limits: [100, 400]
  home: [0, 0, 200, 0, 0, 0]
pose_map:
  degree: 1
  reference: {xyz: [0, 0, 0.2], quaternion: [1, 0, 0, 0]}
  box: {centre: [0, 0, 0, 0, 0, 0], half_width: [1, 1, 1, 1, 1, 1]}
  coefficients: [[0,0,0,0,0,0,0], [0,0,0,0,0,0,0], [0,0,0,0,0,0,0], [0,0,0,0,0,0,0], [0,0,0,0,0,0,0], [0,0,0,0,0,0,0]]
)";

// A point by pivoting, and the part of a pivot.json that it is read from.
constexpr const char* kPivotRequirement = R"(format: hexcal/requirement/1
units: {length: mm, angle: deg}
points: [{name: tip, pivot: pivot.json}]
requirements: [{name: drilling, point: tip, limit: 0.5}]
)";

constexpr const char* kPivotFile =
    R"({"format": "hexcal/pivot/1", "trustworthy": true, "tool": null,
"tip": {"xyz": [0, 0, 0.1], "covariance": [[1e-9, 0, 0], [0, 1e-9, 0], [0, 0, 1e-9]],
"degrees_of_freedom_together": null}}
)";

std::string PivotingTable() {
  std::string table = "pose,body,marker,x,y,z\n";
  for (const char* pose : {"1", "2", "3"})
    for (const char* row : {"base,b1,0,0,0",
                            "base,b2,200,0,0",
                            "base,b3,0,150,0",
                            "tool,t1,0,0,50",
                            "tool,t2,100,0,50",
                            "tool,t3,0,100,50"})
      table += std::string(pose) + "," + row + "\n";
  return table;
}

Effect SampleOf(const EffectKind& kind) {
  Effect effect;
  effect.name = std::string(kind.name);
  if (kind.site == "marker" || kind.name == "swapped_markers") effect.index = {2, 5};
  effect.parameters = Eigen::VectorXd::Constant(kind.SizeFor(effect.index), 0.25);
  effect.standard_deviation = effect.parameters;
  for (const ReferenceKind& reference : kind.references)
    effect.reference[std::string(reference.name)] = std::vector<double>(reference.size, 8.0);
  if (const FaultKind* fault = FindFaultKind(kind.name)) {
    if (!fault->number.empty())
      for (int i = 0; i < fault->size; ++i)
        effect.reference[std::string(fault->number)].push_back(i + 1);
    if (!fault->word.empty())
      effect.found[std::string(fault->word)] = std::string(fault->words.front());
  }
  return effect;
}

}  // namespace

std::vector<std::string> DatasetSamples() { return {kMarkers, kPoses, kLegs}; }

std::vector<std::string> ModelSamples() {
  std::vector<std::string> samples = {
      std::string(kModelHead) + kModelTail,
      std::string(kModelHead) +
          "effects: [{name: unknown, parameters: {coefficients: [1, 2, 3, 4, 5, 6]}, reference: "
          "{centre: 1, half_range: 2, power: 1}, found: {site: leg, driver: time}}]\n",
      std::string(kModelHead) + "effects: [{name: unknown, found: {what: something}}]\n"};
  for (const EffectKind& kind : EffectKinds()) {
    Machine machine;
    machine.dataset = "bench";
    machine.effects = {SampleOf(kind)};
    samples.push_back(WriteMachine(machine));
  }
  return samples;
}

std::vector<std::string> RequirementSamples() { return {kRequirement, kPivotRequirement}; }
std::vector<std::string> ColumnSamples() { return {kColumns}; }
std::vector<std::string> StudySamples() { return {kStudy}; }
std::vector<std::string> PivotingSamples() { return {kPivotingMarkers, kPivotingPoses}; }

std::vector<std::pair<std::string, std::string>> SampleTables() {
  return {{"poses.csv",
           "pose,x,y,z,rx,ry,rz,time,temperature,payload,payload_x,vx,wz,direction_1,humidity\n"
           "1,0,0,200,0,0,0,0,20,1,0,0,0,1,40\n2,1,0,200,0,1,0,60,21,1,0,0,0,-1,41\n"},
          {"measured.csv",
           "pose,x,y,z,rx,ry,rz\n1,0,0,0.1,0,0,0\n2,0,0.01,0.1,0,0.1,0\n3,0.01,0,0.1,0.1,0,0\n"},
          {"plan.yaml", kPoses},
          {"truth.yaml", kModelHead},
          {"pivoting.csv", PivotingTable()},
          {"pivot.json", kPivotFile},
          {"legs.csv",
           "pose,l1,l2,l3,l4,l5,l6\n1,200,200,200,200,200,200\n2,201,200,200,200,200,200\n"
           "3,200,202,200,200,200,200\n"}};
}

const std::vector<const char*> kBeyondSchemas = {
    // Tables and files.
    "no file ",
    "found no file,",
    "expected a whole number from 3 to 3",  // as many poses as the dataset has
    "which is not a file",
    "leaves the dataset's folder",
    "leaves the requirement file's folder",
    "the unknown column ",
    "without a column in the table",
    "found the pose label ",
    "found the pose ",
    "a measurement of pose ",
    "measured poses, expected at least",
    "leg lengths, but no hexapod",
    "the noise of leg lengths",
    "found the unknown key 'leg' in the noise of poses",
    " cells, expected ",
    "in column ",
    "no key 'measurement'",  // which some commands do not need
    // What other values must fit.
    "expected two different markers of the tool body",
    "the name of one of the points",
    "found a second point",
    "found a second requirement",
    "expected one that 'markers' of the map has",
    "expected a marker that bodies: lists",
    "a decimal comma between commas",
    "expected offset as a list of ",
    // What numbers must be together.
    "expected a unit quaternion",
    "expected [min, max] with 0 < min < max",
    "[low, high]",
    "on one line",
    "in one place",
    "between the same joints",
    "a point beyond any machine",
    "go with --solver=nonlinear only",
    "again (it is named at",
    "again, expected a name of its own",
    // Numbers as names.
    "letters, digits, spaces, '.', '-' and '_'",
    "letters, digits, '.', '-' and '_', the first a letter or digit",
    "letters, digits, '.', '_' and '-' only",
};

}  // namespace hexcal::testing
