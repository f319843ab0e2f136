// SPDX-License-Identifier: BSD-3-Clause
#include "apps/plan.h"

#include <fmt/format.h>

#include <filesystem>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/stage_bars.h"
#include "apps/usage_error.h"
#include "config/input_error.h"
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

}  // namespace

int RunPlan(const std::vector<std::string>& files) {
  const std::filesystem::path out = FLAGS_out;
  const bool is_table = IsTable(out);
  const PlanOptions options = OptionsFromFlags();
  CheckPool(options);
  const Dataset dataset = OpenDataset(files[0], false);
  const Machine machine = ReadMachine(FLAGS_model);
  RequireEffects(machine);
  OutputFolder folder(out.has_parent_path() ? out.parent_path().string() : ".",
                      "",
                      {{out.filename().string(), std::string(is_table ? kPlanMark : kPlanFormat)}},
                      InputFiles(dataset, FLAGS_model),
                      FLAGS_force);
  const Plan plan = PlanWithBars(dataset, machine, options);
  for (const std::string& warning : plan.warnings) PrintWarning(warning);
  folder.Write(out.filename().string(),
               is_table
                   ? PlanComments(dataset.name, plan) +
                         RecordedTable(
                             ReadRecordedColumns(dataset.path), plan.poses, plan.base_from_platform)
                   : PlanJson(dataset.name, options, plan));
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", PlanJsonLine(dataset.name, options, plan));
  else if (!FLAGS_quiet)
    fmt::print("{}\n  {:<15}{}\n", PlanTable(dataset.name, plan), "written to", FLAGS_out);
  return kDone;
}

}  // namespace hexcal
