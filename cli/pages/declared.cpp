// SPDX-License-Identifier: MIT
#include "cli/pages/declared.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "carom/version.h"

namespace carom::cli {
namespace {

/// "KIND:{linear,cubic}", the type as CLI11 describes it, in its parts.
void readType(const std::string& type, DeclaredOption& option) {
  option.value = type.substr(0, type.find(':'));
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return;
  for (std::size_t from = open + 1; from <= close;) {
    const std::size_t to = std::min(type.find(',', from), close);
    option.choices.push_back(type.substr(from, to - from));
    from = to + 1;
  }
}

DeclaredOption declaredOption(const CLI::Option& option) {
  DeclaredOption declared;
  for (const std::string& name : option.get_snames()) declared.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) declared.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) readType(option.get_type_name(), declared);
  declared.help = option.get_description();
  declared.required = option.get_required();
  declared.value_optional = option.get_items_expected_min() == 0;
  declared.common = option.get_group() == kCommonOptions;
  return declared;
}

std::vector<DeclaredOption> declaredOptions(const CLI::App& app) {
  std::vector<DeclaredOption> options;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(declaredOption(*option));  // those without one are hidden
  return options;
}

}  // namespace

bool DeclaredOption::file() const { return value == "FILE" || value.find('.') != std::string::npos; }

std::vector<std::string> DeclaredOption::extensions() const {
  const std::size_t dot = value.find('.');
  if (dot == std::string::npos) return {};
  const std::string extension = value.substr(dot + 1);
  if (extension == "glb") return {extension, "gltf"};
  return {extension};
}

DeclaredProgram declaredProgram(const CLI::App& app) {
  DeclaredProgram program{app.get_name(), kVersion, app.get_description(), app.get_footer(), declaredOptions(app), {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    program.commands.push_back(
        {command->get_name(), command->get_description(), command->get_footer(), declaredOptions(*command)});
  return program;
}

}  // namespace carom::cli
