// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "apps/completion.h"
#include "apps/completion_kinds.h"
#include "apps/flag_value.h"
#include "apps/flags.h"

namespace hexcal {
namespace {

using Sort = CompletionKind::Sort;

// Bash takes --name=value apart at the '=' where COMP_WORDBREAKS has it, as it has by default.
constexpr std::string_view kBegin =
    R"(# Completion of hexcal in bash: source <(hexcal completion bash)
_hexcal_take() {  # _hexcal_take PREFIX OPTION...: what compgen gives, a line a reply
  local prefix=$1 reply
  shift
  while IFS= read -r reply; do COMPREPLY+=("$prefix$reply"); done < <(compgen "$@" -- "$cur")
}

_hexcal() {
  local cur=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} flag= glued= prefix= i
  local flags= words= kind= first= rest=
  local before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _hexcal_take '' -W "$_hexcal_commands"
    return
  fi
  if [[ $cur == = ]]; then
    flag=$before cur= glued=yes
  elif [[ $before == = ]]; then
    flag=${COMP_WORDS[COMP_CWORD-2]} glued=yes
  elif [[ $cur == --*=* ]]; then
    flag=${cur%%=*} cur=${cur#*=} prefix=$flag= glued=yes
  elif [[ $before == --* ]]; then
    flag=$before
  fi
  case $command in
)";

constexpr std::string_view kEnd = R"(  esac
  if [[ -n $glued && -z $kind ]]; then return; fi
  if [[ -z $kind && $cur == -* ]]; then
    _hexcal_take '' -W "$flags"
    if [[ ${COMPREPLY[0]} == *= ]]; then compopt -o nospace 2>/dev/null; fi
    return
  fi
  if [[ -z $kind ]]; then
    kind=$rest
    for ((i = 2; i < COMP_CWORD; ++i)); do  # is this the first word that is no flag?
      [[ ${COMP_WORDS[i]} == [-=]* || ${COMP_WORDS[i-1]} == = ]] || break
    done
    if ((i == COMP_CWORD)) && [[ -n $first ]]; then kind=words words=$first; fi
  fi
  case $kind in
    words) _hexcal_take "$prefix" -W "$words" ;;
    folder) compopt -o filenames 2>/dev/null; _hexcal_take "$prefix" -d ;;
    file) compopt -o filenames 2>/dev/null; _hexcal_take "$prefix" -f ;;
    *.*) compopt -o filenames 2>/dev/null
         _hexcal_take "$prefix" -f -X "!*${kind#\*}"; _hexcal_take "$prefix" -d ;;
  esac
}

complete -F _hexcal hexcal
)";

std::string KindText(const CompletionKind& kind) {
  switch (kind.sort) {
    case Sort::kNothing:
      return "none";
    case Sort::kWords:
      return fmt::format("words words='{}'", JoinWords(kind.words));
    case Sort::kFolder:
      return "folder";
    case Sort::kFile:
      break;
  }
  return kind.extension.empty() ? "file" : fmt::format("'*.{}'", kind.extension);
}

std::string CaseOf(const Command& command) {
  std::string flags = "--help", values;
  for (const CommandFlag& flag : command.flags) {
    const bool is_switch = IsSwitch(*FindFlag(flag.name));
    flags += fmt::format(" --{}{}", flag.name, is_switch ? "" : "=");
    if (!is_switch)
      values += fmt::format("        --{}) kind={} ;;\n", flag.name, KindText(KindOfFlag(flag)));
  }
  const CompletionKind rest = KindOfFiles(command);
  std::string text = fmt::format("    {})\n      flags='{}' first='{}'\n",
                                 command.name,
                                 flags,
                                 JoinWords(command.first_words));
  // Words behind the first are few enough to stand in their own variable.
  text += rest.sort == Sort::kWords
              ? fmt::format("      rest=words words='{}'\n", JoinWords(rest.words))
              : fmt::format("      rest={}\n", KindText(rest));
  return text + fmt::format("      case $flag in\n{}      esac\n      ;;\n", values);
}

}  // namespace

std::string BashCompletion() {
  std::vector<std::string_view> names = {"help"};
  for (const Command& command : Commands()) names.push_back(command.name);
  std::string text(kBegin);
  for (const Command& command : Commands()) text += CaseOf(command);
  text += fmt::format("    help) rest=words words='{}' ;;\n", JoinWords(names));
  text += kEnd;
  return text + fmt::format("_hexcal_commands='{} --version'\n", JoinWords(names));
}

}  // namespace hexcal
