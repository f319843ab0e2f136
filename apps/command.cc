// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command.h"

#include <algorithm>
#include <limits>

#include "apps/audit.h"
#include "apps/calibrate.h"
#include "apps/compare.h"
#include "apps/discover.h"
#include "apps/export.h"
#include "apps/import.h"
#include "apps/plan.h"
#include "apps/predict.h"
#include "apps/simulate.h"

namespace hexcal {
namespace {

const Command kCalibrate = {
    "calibrate",
    "where the base and the tool are, and how sure that is",
    "DATASET...",
    1,
    std::numeric_limits<std::size_t>::max(),
    "Estimates the base mount T_B^W and the tool mount T_T^A of each dataset, 12 parameters with "
    "their covariance, and writes result.json, model.yaml and run.json to DIR/<name>/. Where the "
    "dataset states no noise, that of positions and that of orientations are estimated with the "
    "mounts. Exit status 4: there are results, but the data do not determine all 12 parameters or "
    "the solver did not converge.",
    {{"out", true, "DIR", "The results of a dataset go to DIR/<name>/."},
     {"report"},
     {"model", false, {}, "A model whose effects are estimated along with base and tool."},
     {"solver"},
     {"residual"},
     {"start"},
     {"evaluation"},
     {"outliers"},
     {"loss"},
     {"loss_scale"},
     {"covariance"},
     {"noise_position"},
     {"noise_orientation"},
     {"error"},
     {"unit_magnitude"},
     {"iterations"},
     {"tolerance"},
     {"config"},
     {"threads"},
     {"json"},
     {"quiet"},
     {"force"}},
    &RunCalibrate,
};

const Command kCompare = {
    "compare",
    "the closed forms, the linearized iterations and the nonlinear solution side by side",
    "DATASET",
    1,
    1,
    "Solves the dataset by the paper's iteration, the twist iteration, Zhuang's AX = YB, Shah, Li, "
    "Park-Martin and the nonlinear problem (by pose, by marker where markers were measured, "
    "without "
    "outliers), and shows how far each is from the nonlinear solution, "
    "what it leaves over, how well it predicts poses that it has not seen, and what it costs. Says "
    "whether the nonlinear solution is proven to be the best anywhere, whether its covariance may "
    "be used (JCGM 101:2008, clause 8), and from which starts the iterations arrive. Writes "
    "compare.json and run.json, which has the times, to DIR/<name>/. Exit status 4: the nonlinear "
    "solution cannot be trusted.",
    {{"out", true, "DIR", "The results go to DIR/<name>/."},
     {"start", false, {}, "Where the linearized iterations start."},
     {"noise_position"},
     {"noise_orientation"},
     {"seed", false, {}, "The same seed draws the same folds, repetitions and starts."},
     {"unit_magnitude"},
     {"iterations"},
     {"tolerance"},
     {"folds"},
     {"draws"},
     {"starts"},
     {"config"},
     {"threads"},
     {"json"},
     {"quiet"},
     {"force"}},
    &RunCompare,
};

const Command kAudit = {
    "audit",
    "how accurate the calibrated machine is, and whether that is enough",
    "DATASET",
    1,
    1,
    "Calibrates base and tool, says how far points of the tool may be from where they are "
    "predicted "
    "(target registration error, from the covariance of the 12 parameters, the robot's own error "
    "and what else the requirement file states), checks that by repetition, and decides for each "
    "requirement: PASS, FAIL or INCONCLUSIVE, with a guard band. Writes report.html (open it in a "
    "browser), audit.json, "
    "result.json, model.yaml and run.json to DIR/<name>/. Exit status 7 with --gate: a requirement "
    "failed; 4: "
    "the 12 parameters cannot be trusted.",
    {{"out", true, "DIR", "The results go to DIR/<name>/."},
     {"requirement"},
     {"previous"},
     {"gate"},
     {"solver"},
     {"residual"},
     {"start"},
     {"outliers"},
     {"loss"},
     {"loss_scale"},
     {"covariance"},
     {"noise_position"},
     {"noise_orientation"},
     {"error"},
     {"unit_magnitude"},
     {"iterations"},
     {"tolerance"},
     {"folds"},
     {"draws"},
     {"seed", false, {}, "The same seed draws the same folds and repetitions."},
     {"config"},
     {"threads"},
     {"json"},
     {"quiet"},
     {"force"}},
    &RunAudit,
};

const Command kDiscover = {
    "discover",
    "finds where prediction and measurement disagree, and names the missing effect",
    "DATASET",
    1,
    1,
    "Calibrates base and tool, tests what they leave against every effect of docs/effects.md that "
    "the dataset can be tested for, names the one that the data support (or the class, or says "
    "that it is unknown), adds it to the model, fits again and shows how far the gap between "
    "prediction "
    "and measurement shrinks, on poses that neither the fit nor the choice has seen. Writes "
    "report.html (open it in a browser), discovery.json, result.json, model.yaml (for predict, "
    "simulate and calibrate --model) and run.json to DIR/<name>/. No verdict changes the exit "
    "status; 4: the 12 parameters cannot be "
    "trusted.",
    {{"out", true, "DIR", "The results go to DIR/<name>/."},
     {"alpha"},
     {"bootstraps"},
     {"noise_position"},
     {"noise_orientation"},
     {"folds"},
     {"seed", false, {}, "The same seed draws the same noise and the same folds."},
     {"config"},
     {"threads"},
     {"json"},
     {"quiet"},
     {"force"}},
    &RunDiscover,
};

const Command kExport = {
    "export",
    "a calibration for other programs",
    "FORMAT RESULT.json",
    2,
    2,
    ExportDescription(),
    {{"out", true, "DIR", "The files go to DIR."},
     {"dataset"},
     {"world_frame"},
     {"base_frame"},
     {"platform_frame"},
     {"tool_frame"},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunExport,
};

const Command kImport = {
    "import",
    "other programs' files to a dataset",
    "FORMAT FILE...",
    2,
    std::numeric_limits<std::size_t>::max(),
    ImportDescription(),
    {{"out", true, "DIR", "The dataset goes to DIR."},
     {"robot"},
     {"robot_format"},
     {"robot_rotation"},
     {"robot_columns"},
     {"robot_map"},
     {"robot_inverse"},
     {"base"},
     {"tool"},
     {"base_body"},
     {"tool_body"},
     {"measured_inverse"},
     {"map"},
     {"pair"},
     {"frames"},
     {"stops"},
     {"window"},
     {"time_offset"},
     {"missing_value"},
     {"kind"},
     {"static_tracker"},
     {"hexapod"},
     {"initial"},
     {"name"},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunImport,
};

const Command kPlan = {
    "plan",
    "which poses to measure next, for base and tool or to tell rival effects apart",
    "DATASET",
    1,
    1,
    "Takes the machine of the model and the poses that the dataset has measured already, and "
    "chooses further poses within reach, with loads, temperatures and whatever else is a column of "
    "robot_poses: those that determine base and tool best (D-optimality), or that tell the model's "
    "effects from what they could also be (T-optimality). Says how sure the 12 parameters and how "
    "far apart the rivals are now and will be then; where no pose can separate two, what "
    "experiment would. FILE.csv is a table for the robot_poses of a new dataset, in the columns "
    "and units of this one and in the order in which to measure; FILE.json holds all that is known "
    "of the plan. The dataset may have no measured poses yet if it states its noise.",
    {{"model", true},
     {"out", true, "FILE", "The plan to write, .csv or .json."},
     {"for"},
     {"poses"},
     {"pool"},
     {"settings"},
     {"noise_position"},
     {"noise_orientation"},
     {"seed", false, {}, "The same seed draws the same pool and the same order."},
     {"config"},
     {"json"},
     {"quiet"},
     {"force"}},
    &RunPlan,
};

const Command kPredict = {
    "predict",
    "where the machine really is, by a calibrated model",
    "DATASET",
    1,
    1,
    "Reads the poses that the robot reported (robot_poses) and writes, for each, the pose of the "
    "tool in the world by the model: T_T^W = T_B^W T_A^B T_T^A, with the model's effects of the "
    "robot and its mounts. The dataset needs no measurement. The table has the columns "
    "pose,x,y,z,qw,qx,qy,qz, in m, the quaternion's scalar first.",
    {{"model", true},
     {"out", true, "FILE.csv", "The table to write."},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunPredict,
};

const Command kSimulate = {
    "simulate",
    "what the tracker would see of a calibrated machine, as a new dataset",
    "DATASET",
    1,
    1,
    "Takes the machine of the model as the truth, moves it through the dataset's poses and writes "
    "what the tracker would see as a new dataset, in m and rad, with noise drawn from the standard "
    "deviations that the dataset states. The dataset's own measurement, if it has readings, is "
    "replaced.",
    {{"model", true},
     {"out", true, "DIR", "The new dataset goes to DIR/<name>/."},
     {"seed"},
     {"noise"},
     {"config"},
     {"quiet"},
     {"force"}},
    &RunSimulate,
};

}  // namespace

const CommandFlag* Command::FindFlag(std::string_view flag) const {
  const auto found = std::find_if(
      flags.begin(), flags.end(), [flag](const CommandFlag& own) { return own.name == flag; });
  return found == flags.end() ? nullptr : &*found;
}

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {
      kAudit, kCalibrate, kCompare, kDiscover, kExport, kImport, kPlan, kPredict, kSimulate};
  return commands;
}

const Command* FindCommand(std::string_view name) {
  const std::vector<Command>& commands = Commands();
  const auto found = std::find_if(
      commands.begin(), commands.end(), [name](const Command& own) { return own.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace hexcal
