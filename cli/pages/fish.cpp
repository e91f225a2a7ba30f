// SPDX-License-Identifier: MIT
// Completion in fish: one `complete` for each command and option.
#include <array>

#include "cli/pages/pages.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

std::string fishText(const std::string& text) {
  return "'" + escaped(text, std::array<std::pair<char, const char*>, 2>{{{'\'', "\\'"}, {'\\', "\\\\"}}}) + "'";
}

/// The files that a value may be, as a list that fish makes when it is asked for.
std::string fishFiles(const std::vector<std::string>& extensions) {
  std::vector<std::string> suffixes;
  for (const std::string& extension : extensions) suffixes.push_back("(__fish_complete_suffix ." + extension + ")");
  return "'" + joined(suffixes, " ") + "'";
}

std::string fishValue(const DeclaredOption& option) {
  if (option.value.empty()) return "";
  if (!option.choices.empty()) return " -x -a '" + joined(option.choices, " ") + "'";
  if (!option.extensions().empty()) return " -x -k -a " + fishFiles(option.extensions());
  if (option.file()) return " -r -F";
  return option.value_optional ? "" : " -x";
}

std::string fishOption(const std::string& condition, const DeclaredOption& option) {
  std::string line = "complete -c carom -n " + condition;
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.positional()) {
    if (!option.choices.empty()) return line + " -a '" + joined(option.choices, " ") + "'\n";
    return line + " -k -a " + fishFiles(option.extensions()) + "\n";
  }
  return line + fishValue(option) + " -d " + fishText(option.help) + "\n";
}

}  // namespace

std::string fishCompletion(const DeclaredProgram& program) {
  std::string text = "# Completion of carom " + program.version +
                     " in fish, written by `carom completion fish`.\ncomplete -c carom -f\n";
  for (const DeclaredOption& option : program.options) text += fishOption("__fish_use_subcommand", option);
  for (const DeclaredCommand& command : program.commands)
    text += "complete -c carom -n __fish_use_subcommand -a " + command.name + " -d " + fishText(command.summary) + "\n";
  for (const DeclaredCommand& command : program.commands)
    for (const DeclaredOption& option : command.options)
      text += fishOption("'__fish_seen_subcommand_from " + command.name + "'", option);
  return text;
}

}  // namespace carom::cli
