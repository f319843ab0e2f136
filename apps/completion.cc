// SPDX-License-Identifier: BSD-3-Clause
#include "apps/completion.h"

#include <fmt/format.h>

#include "apps/exit_status.h"
#include "apps/usage_error.h"
#include "config/nearest_word.h"

namespace hexcal {
namespace {

int RunCompletion(const std::vector<std::string>& words) {
  const std::string& shell = words[0];
  if (shell != "bash" && shell != "zsh")
    throw UsageError(
        fmt::format("completion: found '{}', expected bash or zsh{}\nTry 'hexcal help completion'.",
                    shell,
                    DidYouMean(shell, {"bash", "zsh"})));
  fmt::print("{}", shell == "bash" ? BashCompletion() : ZshCompletion());
  return kDone;
}

}  // namespace

Command CompletionCommand() {
  return {
      "completion",
      "completes commands, flags and files in bash or zsh",
      "bash|zsh",
      1,
      1,
      "Prints a script that completes commands, flags, their values and files by their "
      "extension. For bash: put 'source <(hexcal completion bash)' into ~/.bashrc. For zsh: "
      "'source <(hexcal completion zsh)' into ~/.zshrc, after compinit.",
      {},
      &RunCompletion,
      {{"hexcal completion bash > hexcal.bash && source ./hexcal.bash", "Completes in this shell."},
       {"hexcal completion zsh > _hexcal", "For a folder of zsh's fpath."}},
      {"bash", "zsh"}};
}

}  // namespace hexcal
