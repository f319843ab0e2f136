// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "apps/flags.h"
#include "geometry/rotation_order.h"

namespace hexcal {
namespace {

constexpr std::string_view kResults = "Results";
constexpr std::string_view kMethod = "Method";
constexpr std::string_view kNoise = "Noise";
constexpr std::string_view kLinearized = "The linearized solver";
constexpr std::string_view kComparison = "Comparison";
constexpr std::string_view kAccuracy = "Accuracy";
constexpr std::string_view kDiscovery = "Discovery";
constexpr std::string_view kHistory = "History";
constexpr std::string_view kFiles = "What the files do not say";
constexpr std::string_view kPlanning = "Planning";
constexpr std::string_view kNames = "What others call the frames";
constexpr std::string_view kRunning = "Running";

std::vector<FlagSpec> MakeSpecs() {
  std::vector<FlagSpec> specs = {
      {"out", kResults, "PATH", ""},
      {"dataset", kResults, "FILE", ""},
      {"report", kResults, "", ""},
      {"history", kResults, "FILE.sqlite", ""},
      {"operator", kResults, "TEXT", "", {}, 0.0, 0.0, false, "history"},
      {"json", kResults, "", ""},
      {"quiet", kResults, "", ""},
      {"force", kResults, "", ""},
      {"model", kMethod, "FILE", ""},
      {"solver", kMethod, "", "", {"nonlinear", "linearized"}},
      {"residual",
       kMethod,
       "",
       "marker where markers were measured and the solver is nonlinear, else pose",
       {"marker", "pose"}},
      {"start",
       kMethod,
       "",
       "closed_form for nonlinear; initial, where the dataset has one, else identity for "
       "linearized",
       {"closed_form", "initial", "identity", "shah", "park_martin"}},
      {"outliers", kMethod, "", "", {"keep", "reject"}},
      {"evaluation", kMethod, "", "", {"streamed", "per_pose"}},
      {"loss", kMethod, "", "", {"none", "huber", "cauchy", "tukey"}},
      {"loss_scale", kMethod, "SIGMAS", "95 % efficient", {}, 0.1, 1000.0, false, "loss"},
      {"covariance", kMethod, "", "", {"model", "sandwich"}},
      {"noise_position", kNoise, "M", "estimated", {}, 1e-20, 1.0, false, "noise_orientation"},
      {"noise_orientation", kNoise, "RAD", "estimated", {}, 1e-20, 1.0, false, "noise_position"},
      {"noise", kNoise, "FACTOR", "", {}, 0.0, 1e6},
      {"seed", kNoise, "N", "", {}, 0.0},
      {"error", kLinearized, "", "", {"paper", "twist"}},
      {"unit_magnitude",
       kLinearized,
       "",
       "",
       {"approach_first", "normal_first", "nearest_rotation", "columns", "rows"}},
      {"iterations", kLinearized, "N", "", {}, 1, 10000},
      {"tolerance", kLinearized, "STEP", "", {}, 0.0, 1.0, true},
      {"folds", kComparison, "N", "", {}, 2, 1000},
      {"draws", kComparison, "N", "", {}, 1000, 1e7},
      {"starts", kComparison, "N", "", {}, 0, 10000},
      {"requirement", kAccuracy, "FILE.yaml", ""},
      {"previous", kAccuracy, "FILE.json", ""},
      {"gate", kAccuracy, "", ""},
      {"alpha", kDiscovery, "P", "", {}, 1e-4, 0.2},
      {"bootstraps", kDiscovery, "N", "", {}, 99, 100000},
      {"head", kHistory, "HASH", ""},
      {"since", kHistory, "N", "", {}, 1, 1e9},
      {"baseline", kHistory, "N", "", {}, 1, 1e6},
      {"robot", kFiles, "FILE", ""},
      {"robot_format", kFiles, "FORMAT", "told by the file's beginning"},
      {"robot_rotation", kFiles, "", "", {kRotationOrders.begin(), kRotationOrders.end()}},
      {"robot_columns", kFiles, "A,B,C,D,E,F", "found by their names"},
      {"robot_inverse", kFiles, "", ""},
      {"base", kFiles, "NAME", ""},
      {"tool", kFiles, "NAME", "the only body in the file"},
      {"base_body", kFiles, "FILE", ""},
      {"tool_body", kFiles, "FILE", ""},
      {"measured_inverse", kFiles, "", ""},
      {"pair", kFiles, "", "", {"rows", "files", "time", "labels"}},
      {"frames", kFiles, "N", "", {}, 1, 1e6},
      {"stops", kFiles, "S", "every row is a pose", {}, 0.0, 1e6, true},
      {"window", kFiles, "S", "", {}, 0.0, 1e6},
      {"time_offset", kFiles, "S", "", {}, -3e9, 3e9},
      {"missing_value", kFiles, "X", "none", {}, -1e30, 1e30},
      {"kind", kFiles, "", "", {"any", "markers", "poses"}},
      {"static_tracker", kFiles, "", ""},
      {"hexapod", kFiles, "FILE.yaml", ""},
      {"map", kFiles, "FILE.yaml", ""},
      {"robot_map", kFiles, "FILE.yaml", ""},
      {"initial", kFiles, "FILE.yaml", ""},
      {"name", kFiles, "NAME", "that of the folder, or of the table"},
      {"units",
       kFiles,
       "LENGTH,ANGLE",
       "a YAML file states its own",
       {"m,rad", "m,deg", "mm,rad", "mm,deg"}},
      {"for",
       kPlanning,
       "",
       "rivals where the model's effects have any, else parameters",
       {"parameters", "rivals"}},
      {"poses", kPlanning, "N", "", {}, 1, 1000},
      {"pool", kPlanning, "N", "", {}, 50, 20000},
      {"settings", kPlanning, "COLUMN=A:B,...", "as the dataset has seen"},
      {"world_frame", kNames, "NAME", ""},
      {"base_frame", kNames, "NAME", ""},
      {"platform_frame", kNames, "NAME", ""},
      {"tool_frame", kNames, "NAME", ""},
      {"config", kRunning, "FILE.yaml", ""},
      {"task", kRunning, "K/N", ""},
      {"merge", kRunning, "", ""},
      {"retry", kRunning, "", ""},
      {"threads", kRunning, "N", "all cores", {}, 1, 1024},
  };
  const auto only_with = [&specs](
                             std::string_view name, std::string_view flag, std::string_view value) {
    for (FlagSpec& spec : specs) {
      if (spec.name != name) continue;
      spec.only_with_flag = flag;
      spec.only_with_value = value;
    }
  };
  only_with("frames", "pair", "rows");
  only_with("stops", "pair", "time");
  only_with("window", "pair", "time");
  only_with("time_offset", "pair", "time");
  for (FlagSpec& spec : specs) {
    if (spec.group != kLinearized) continue;
    spec.only_with_flag = "solver";
    spec.only_with_value = "linearized";
  }
  return specs;
}

}  // namespace

const std::vector<FlagSpec>& FlagSpecs() {
  static const std::vector<FlagSpec> specs = MakeSpecs();
  return specs;
}

const FlagSpec* FindFlag(std::string_view name) {
  const std::vector<FlagSpec>& specs = FlagSpecs();
  const auto found = std::find_if(
      specs.begin(), specs.end(), [name](const FlagSpec& spec) { return spec.name == name; });
  return found == specs.end() ? nullptr : &*found;
}

}  // namespace hexcal
