// SPDX-License-Identifier: MIT
// Completion in zsh, by its function _arguments.
#include <array>

#include "cli/pages/pages.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

/// A text in single quotes, with a backslash before what the specifications of _arguments give a meaning to.
std::string zshText(const std::string& text) {
  return escaped(text, std::array<std::pair<char, const char*>, 5>{
                           {{'\'', "'\\''"}, {'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\\', "\\\\"}}});
}

/// ":FILE:_files", the end of a specification.
std::string zshValue(const DeclaredOption& option) {
  if (option.value.empty()) return "";
  std::string text = std::string(option.value_optional ? "::" : ":") + zshText(option.value) + ":";
  if (!option.choices.empty()) return text + "(" + joined(option.choices, " ") + ")";
  if (!option.file()) return text + " ";
  const std::vector<std::string> extensions = option.extensions();
  if (extensions.empty()) return text + "_files";
  return text + "_files -g \"*.(" + joined(extensions, "|") + ")\"";
}

std::string zshSpecification(const DeclaredOption& option) {
  if (option.positional()) return "'1" + zshValue(option) + "'";
  std::vector<std::string> forms;
  for (const std::string& name : option.names) {
    const bool takes = !option.value.empty() && !option.value_optional;
    forms.push_back(name + (!takes ? "" : name.starts_with("--") ? "=" : "+"));
  }
  const std::string end = "[" + zshText(option.help) + "]" + zshValue(option) + "'";
  if (forms.size() == 1) return "'*" + forms.front() + end;
  return "'*'{" + joined(forms, ",") + "}'" + end;
}

std::string zshArguments(const std::vector<DeclaredOption>& options, const std::string& indent) {
  std::string text = indent + "_arguments -s";
  for (const DeclaredOption& option : options) text += " \\\n" + indent + "  " + zshSpecification(option);
  return text + "\n";
}

}  // namespace

std::string zshCompletion(const DeclaredProgram& program) {
  std::string text = "#compdef carom\n# Completion of carom " + program.version +
                     " in zsh, written by `carom completion zsh`.\n_carom() {\n  if (( CURRENT == 2 )); then\n"
                     "    local -a commands=(\n";
  for (const DeclaredCommand& command : program.commands)
    text += "      '" + command.name + ":" + zshText(command.summary) + "'\n";
  text += "    )\n    _describe -t commands command commands\n" + zshArguments(program.options, "    ");
  text += "    return\n  fi\n  local command=$words[2]\n  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const DeclaredCommand& command : program.commands)
    text += "    " + command.name + ")\n" + zshArguments(command.options, "      ") + "      ;;\n";
  // Both as a file of $fpath and in `source <(carom completion zsh)`.
  return text + "  esac\n}\n"
                "if [[ $funcstack[1] == _carom ]]; then\n  _carom \"$@\"\nelse\n  compdef _carom carom\nfi\n";
}

}  // namespace carom::cli
