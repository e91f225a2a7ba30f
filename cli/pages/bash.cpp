// SPDX-License-Identifier: MIT
// Completion in bash, with nothing but its builtins.
#include "cli/pages/pages.h"

#include "formats/base/short_text.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

constexpr const char* kBashHead = R"(_carom() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= i
  # --option=value comes as three words.
  if [[ $word == = ]]; then
    word=
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
)";

constexpr const char* kBashTail = R"(  esac
  COMPREPLY=()
  if [[ $word == -?* ]]; then words=$options; fi
  mapfile -t COMPREPLY < <(
    compgen -W "$words" -- "$word"
    if [[ $word != -?* ]]; then
      for i in $extensions; do compgen -f -X "!*.$i" -- "$word"; done
      if [[ -n $extensions ]]; then compgen -d -- "$word"; fi
      if [[ -n $files ]]; then compgen -f -- "$word"; fi
    fi
  )
}
complete -o filenames -F _carom carom
)";

/// Assignments for what a value may be.
std::string bashValue(const DeclaredOption& option) {
  std::string text;
  if (!option.choices.empty()) text += " words='" + joined(option.choices, " ") + "'";
  if (!option.extensions().empty()) text += " extensions='" + joined(option.extensions(), " ") + "'";
  if (option.file() && option.extensions().empty()) text += " files=yes";
  return text;
}

std::string bashOptions(const std::vector<DeclaredOption>& options) {
  std::vector<std::string> names;
  for (const DeclaredOption& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return joined(names, " ");
}

std::string bashCommand(const DeclaredCommand& command) {
  std::string text = "    " + command.name + ")\n      options='" + bashOptions(command.options) + "'\n";
  text += "      case $before in\n";
  std::string positional;
  for (const DeclaredOption& option : command.options) {
    if (option.positional()) positional += bashValue(option);
    if (option.positional() || option.value.empty() || option.value_optional) continue;
    text += "        " + joined(option.names, "|") + ") options=" + bashValue(option) + " ;;\n";
  }
  return text + "        *) " + (positional.empty() ? ":" : positional.substr(1)) + " ;;\n      esac\n      ;;\n";
}

}  // namespace

std::string bashCompletion(const DeclaredProgram& program) {
  std::vector<std::string> names;
  for (const DeclaredCommand& command : program.commands) names.push_back(command.name);
  std::string text = "# Completion of carom " + program.version + " in bash, written by `carom completion bash`.\n";
  text += kBashHead;
  text += "      " + joined(names, "|") + ")\n        command=${COMP_WORDS[i]}\n        break\n        ;;\n";
  text += "    esac\n  done\n  local options= words= extensions= files=\n  case $command in\n";
  text += "    '') options='" + bashOptions(program.options) + "' words='" + joined(names, " ") + "' ;;\n";
  for (const DeclaredCommand& command : program.commands) text += bashCommand(command);
  return text + kBashTail;
}

}  // namespace carom::cli
