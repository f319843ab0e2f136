// SPDX-License-Identifier: BSD-3-Clause
#include "apps/audit.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "apps/audit_fit.h"
#include "apps/calibrate_options.h"
#include "apps/dataset_files.h"
#include "apps/estimate_mounts.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/history_entry.h"
#include "apps/in_order.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/record_of.h"
#include "apps/report_page.h"
#include "apps/usage_error.h"
#include "report/audit_html.h"
#include "report/audit_json.h"
#include "report/audit_table.h"
#include "report/compare_json.h"
#include "report/result_json.h"

namespace hexcal {
namespace {

constexpr std::string_view kAuditMark = R"("format": "hexcal/audit/)";

// Everything but the settings that say where results go and how they are shown.
bool Matters(std::string_view setting) {
  for (const char* other :
       {"out", "config", "threads", "json", "quiet", "force", "gate", "history", "operator"})
    if (setting == other) return false;
  return true;
}

AuditIdentity IdentityOf(const RunRecord& record, const std::string& result) {
  AuditIdentity identity;
  identity.inputs = HashFiles(record.inputs);
  std::string all;
  for (const HashedFile& file : identity.inputs) all += file.sha256 + "\n";
  for (const auto& [name, value] : record.settings)
    if (Matters(name)) all += fmt::format("{}={}\n", name, value);
  identity.id = Sha256(all + result);
  return identity;
}

Requirements OpenRequirements(const std::string& path, const Dataset& dataset) {
  Requirements requirements = ReadRequirements(path);
  for (const NamedPoint& point : requirements.points)
    if (point.pivot) RequireSameTool(*point.pivot, dataset);
  return requirements;
}

std::vector<std::string> AllInputs(const Dataset& dataset,
                                   const std::optional<Requirements>& requirements) {
  std::vector<std::string> files = InputFiles(dataset, FLAGS_model);
  if (requirements) {
    files.push_back(FLAGS_requirement);
    for (const NamedPoint& point : requirements->points)
      if (point.pivot) files.push_back(point.pivot->path);
  }
  if (!FLAGS_previous.empty()) files.push_back(FLAGS_previous);
  return files;
}

// The effects to audit with; nothing without a --model, or where that has none.
std::optional<Machine> OpenModel() {
  if (FLAGS_model.empty()) return std::nullopt;
  Machine model = ReadMachine(FLAGS_model);
  if (model.effects.empty() && !model.pose_map) return std::nullopt;
  RequireOptionsForEffects(CalibrateOptionsFromFlags());
  if (!FLAGS_previous.empty())
    throw UsageError(
        "--previous compares base and tool alone: it does not go with a --model with effects");
  return model;
}

int RunAudit(const std::vector<std::string>& files) {
  const auto start = std::chrono::steady_clock::now();
  if (FLAGS_gate && FLAGS_requirement.empty())
    throw UsageError("--gate needs a --requirement to gate by");
  const Dataset dataset = OpenDataset(files[0], true);
  IsByMarkers(dataset, CalibrateOptionsFromFlags());  // wrong usage shows before anything is read
  const std::optional<Machine> model = OpenModel();
  std::optional<Requirements> requirements;
  if (!FLAGS_requirement.empty()) requirements = OpenRequirements(FLAGS_requirement, dataset);
  std::optional<EarlierResult> earlier;
  if (!FLAGS_previous.empty()) earlier = ReadEarlierResult(FLAGS_previous);
  OutputFolder folder(FLAGS_out,
                      dataset.name,
                      {{"audit.json", std::string(kAuditMark)},
                       {"result.json", std::string(kResultMark)},
                       {"model.yaml", std::string(kModelMark)},
                       {"run.json", std::string(kRunMark)},
                       ReportPage("audit")},
                      AllInputs(dataset, requirements),
                      FLAGS_force);
  CheckHistoryFlag();
  const auto [audit, machine] = FitAndAudit({dataset, model, requirements, earlier});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunRecord record = RecordOf("audit", dataset, seconds, ThreadsFor(FLAGS_threads));
  record.inputs = AllInputs(dataset, requirements);
  record.methods = TimesOf(audit.comparison);
  const std::string result = ResultJson(audit.header, audit.estimate, machine.effects);
  AuditIdentity identity = IdentityOf(record, result);
  HistoryEntry entry(
      "audit", dataset, record, audit.header, audit.estimate, machine.effects, result);
  record.history = entry.mark();
  identity.log = entry.log();
  folder.Write({{"audit.json", AuditJson(identity, audit)},
                {"model.yaml", WriteMachine(machine)},
                {"run.json", RunJson(record)},
                {"result.json", result},
                {"report.html", AuditHtml(identity, record, audit, result)}});
  entry.Append();
  PrintNewWarnings(dataset, audit.estimate.warnings, "audit.json");
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", AuditJsonLine(identity, audit));
  else if (!FLAGS_quiet)
    fmt::print("{}  {:<15}{}\n\n", AuditTable(audit), "written to", folder.path());
  if (!audit.estimate.IsTrustworthy()) return kNotTrusted;
  return FLAGS_gate && audit.compliance == Compliance::kFail ? kRequirementFailed : kDone;
}

}  // namespace

Command AuditCommand() {
  return {
      "audit",
      "how accurate the calibrated machine is, and whether that is enough",
      "DATASET",
      1,
      1,
      "Calibrates base and tool, says how far points of the tool may be from where they are "
      "predicted "
      "(target registration error, from the covariance of the 12 parameters, the robot's own error "
      "and what else the requirement file states), checks that by repetition, and decides for each "
      "requirement: PASS, FAIL or INCONCLUSIVE, with a guard band. Writes report.html (open it in "
      "a "
      "browser), audit.json, "
      "result.json, model.yaml and run.json to DIR/<name>/. Exit status 7 with --gate: a "
      "requirement "
      "failed; 4: "
      "the 12 parameters cannot be trusted.",
      {{"out", true, "DIR", "The results go to DIR/<name>/."},
       {"requirement"},
       {"previous"},
       {"gate"},
       {"history"},
       {"operator"},
       {"model",
        false,
        {},
        "A model whose effects are estimated along with base and tool, and are in the errors."},
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
      {{"hexcal audit examples/neurobot/dataset.yaml "
        "--requirement=examples/neurobot/requirement.yaml --out=out",
        "Is the tool's tip within 0.5 mm? out/neurobot/report.html is the report to sign."}},
  };
}

}  // namespace hexcal
