// SPDX-License-Identifier: BSD-3-Clause
#include "apps/plan.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/stage_bars.h"
#include "apps/usage_error.h"
#include "config/input_error.h"
#include "config/number.h"
#include "discovery/plan.h"
#include "measurement/recorded_table.h"
#include "model/machine.h"
#include "report/plan_json.h"
#include "report/plan_table.h"

namespace hexcal {
namespace {

constexpr std::string_view kPlanFormat = R"("format": "hexcal/plan/)";

PlanOptions OptionsFromFlags() {
  PlanOptions options;
  if (!FLAGS_for.empty())
    options.goal = FLAGS_for == "rivals" ? PlanGoal::kRivals : PlanGoal::kParameters;
  options.poses = FLAGS_poses;
  options.pool = FLAGS_pool;
  options.seed = static_cast<std::uint64_t>(FLAGS_seed);
  if (FLAGS_noise_position > 0)
    options.noise = NoiseLevels{FLAGS_noise_position, FLAGS_noise_orientation};
  return options;
}

std::vector<std::string> Split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

[[noreturn]] void RefuseSetting(const std::string& found, const std::string& expected) {
  throw UsageError(fmt::format("plan: --settings: found '{}', expected {}", found, expected));
}

const Covariate& ColumnCalled(const Dataset& dataset, const std::string& name) {
  std::vector<std::string> names;
  for (const Covariate& covariate : dataset.robot_poses.covariates) {
    if (covariate.name == "time") continue;  // it passes by itself
    if (covariate.name == name) return covariate;
    names.push_back(covariate.name);
  }
  RefuseSetting(name,
                names.empty() ? "no settings: the dataset has no covariates that can be set"
                              : fmt::format("one of {}", fmt::join(names, ", ")));
}

// payload=0:2:5,temperature=18:28, in the columns' own units.
ChosenSettings SettingsFromFlag(const Dataset& dataset) {
  ChosenSettings settings;
  if (FLAGS_settings.empty()) return settings;
  for (const std::string& entry : Split(FLAGS_settings, ',')) {
    const std::vector<std::string> sides = Split(entry, '=');
    if (sides.size() != 2) RefuseSetting(entry, "COLUMN=A:B:..., as payload=0:5");
    const Covariate& column = ColumnCalled(dataset, sides[0]);
    if (settings.count(column.name) > 0) RefuseSetting(entry, "each column once");
    for (const std::string& text : Split(sides[1], ':')) {
      const std::optional<double> value = ParseDouble(text);
      if (!value || !std::isfinite(*value)) RefuseSetting(text, "a number");
      settings[column.name].push_back(column.unit.factor * *value);
    }
  }
  return settings;
}

bool IsTable(const std::filesystem::path& out) {
  if (out.extension() == ".csv") return true;
  if (out.extension() == ".json") return false;
  throw UsageError(fmt::format(
      "plan: --out: found '{}', expected a file that ends in .csv or .json", FLAGS_out));
}

Plan PlanWithBars(const Dataset& dataset, const Machine& machine, PlanOptions options) {
  StageBars bars(FLAGS_quiet);
  options.progress = [&bars](const char* stage, int done, int of) { bars.Update(stage, done, of); };
  return MakePlan(dataset, machine, options);
}

void RequireEffects(const Machine& machine) {
  if (FLAGS_for != "rivals" || !machine.effects.empty()) return;
  throw InputError(FileLocation(FLAGS_model),
                   "a model without effects",
                   "effects, as 'hexcal discover' finds them, to tell from their rivals");
}

void CheckPool(const PlanOptions& options) {
  if (options.poses <= options.pool) return;
  throw UsageError(fmt::format(
      "plan: --poses: found {}, expected at most --pool, {}", options.poses, options.pool));
}

int RunPlan(const std::vector<std::string>& files) {
  const std::filesystem::path out = FLAGS_out;
  const bool is_table = IsTable(out);
  PlanOptions options = OptionsFromFlags();
  CheckPool(options);
  const Dataset dataset = OpenDataset(files[0], false);
  const Machine machine = ReadMachine(FLAGS_model);
  RequireEffects(machine);
  options.settings = SettingsFromFlag(dataset);
  OutputFolder folder(out.has_parent_path() ? out.parent_path().string() : ".",
                      "",
                      {{out.filename().string(), std::string(is_table ? kPlanMark : kPlanFormat)}},
                      InputFiles(dataset, FLAGS_model),
                      FLAGS_force);
  const Plan plan = PlanWithBars(dataset, machine, options);
  for (const std::string& warning : plan.warnings) PrintWarning(warning);
  folder.Write(
      {{out.filename().string(),
        is_table ? PlanComments(dataset.name, plan) +
                       RecordedTable(
                           ReadRecordedColumns(dataset.path), plan.poses, plan.base_from_platform)
                 : PlanJson(dataset.name, options, plan)}});
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", PlanJsonLine(dataset.name, options, plan));
  else if (!FLAGS_quiet)
    fmt::print("{}\n  {:<15}{}\n", PlanTable(dataset.name, plan), "written to", FLAGS_out);
  return kDone;
}

}  // namespace

Command PlanCommand() {
  return {
      "plan",
      "which poses to measure next, for base and tool or to tell rival effects apart",
      "DATASET",
      1,
      1,
      "Takes the machine of the model and the poses that the dataset has measured already, and "
      "chooses further poses within reach, with loads, temperatures and whatever else is a column "
      "of "
      "robot_poses: those that determine base and tool best (D-optimality), or that tell the "
      "model's "
      "effects from what they could also be (T-optimality). Says how sure the 12 parameters and "
      "how "
      "far apart the rivals are now and will be then; where no pose can separate two, what "
      "experiment would. FILE.csv is a table for the robot_poses of a new dataset, in the columns "
      "and units of this one and in the order in which to measure; FILE.json holds all that is "
      "known "
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
      {{"hexcal plan examples/neurobot/dataset.yaml --model=out/neurobot/model.yaml --out=next.csv",
        "Twelve more poses for base and tool."}},
  };
}

}  // namespace hexcal
