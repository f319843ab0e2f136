// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command.h"

#include <algorithm>

#include "apps/audit.h"
#include "apps/batch.h"
#include "apps/calibrate.h"
#include "apps/compare.h"
#include "apps/completion.h"
#include "apps/discover.h"
#include "apps/export.h"
#include "apps/history.h"
#include "apps/import.h"
#include "apps/init.h"
#include "apps/man.h"
#include "apps/pivot.h"
#include "apps/plan.h"
#include "apps/predict.h"
#include "apps/schema.h"
#include "apps/simulate.h"

namespace hexcal {

const CommandFlag* Command::FindFlag(std::string_view flag) const {
  const auto found = std::find_if(
      flags.begin(), flags.end(), [flag](const CommandFlag& own) { return own.name == flag; });
  return found == flags.end() ? nullptr : &*found;
}

const std::vector<Command>& Commands() {
  static const std::vector<Command> commands = {AuditCommand(),
                                                BatchCommand(),
                                                CalibrateCommand(),
                                                CompareCommand(),
                                                CompletionCommand(),
                                                DiscoverCommand(),
                                                ExportCommand(),
                                                HistoryCommand(),
                                                ImportCommand(),
                                                InitCommand(),
                                                ManCommand(),
                                                PivotCommand(),
                                                PlanCommand(),
                                                PredictCommand(),
                                                SchemaCommand(),
                                                SimulateCommand()};
  return commands;
}

const Command* FindCommand(std::string_view name) {
  const std::vector<Command>& commands = Commands();
  const auto found = std::find_if(
      commands.begin(), commands.end(), [name](const Command& own) { return own.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace hexcal
