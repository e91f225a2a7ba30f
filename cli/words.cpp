// SPDX-License-Identifier: MIT
#include "cli/words.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "cli/command.h"
#include "formats/base/nearest_word.hpp"
#include "formats/base/short_text.hpp"

namespace carom::cli {

using namespace formats_detail;

namespace {

std::vector<std::string> commandNames() {
  std::vector<std::string> names;
  for (const Command* command : commands()) names.emplace_back(command->name);
  return names;
}

std::string meant(const std::string& word, const std::vector<std::string>& known) {
  const std::optional<std::string> nearest = nearestWord(word, known);
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

}  // namespace

std::vector<std::string> orderedWords(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty()) return words;
  if (words[0] == "help") {
    if (words.size() == 1) return {"--help"};
    const std::vector<std::string> names = commandNames();
    if (std::find(names.begin(), names.end(), words[1]) == names.end()) return {words[1]};  // which says that there is none
    return {words[1], "--help"};
  }
  if (!words[0].starts_with('-') || words[0] == "-V" || words[0] == "--version") return words;
  const std::vector<std::string> names = commandNames();
  const auto command = std::find_first_of(words.begin(), words.end(), names.begin(), names.end());
  if (command != words.end()) std::rotate(words.begin(), command, command + 1);
  return words;
}

std::string describeNoCommand(const std::vector<std::string>& words) {
  const std::vector<std::string> names = commandNames();
  if (words.empty()) return "found no command, expected one of " + joined(names);
  return "found '" + words[0] + "', expected one of " + joined(names) + meant(words[0], names);
}

std::string meantOption(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name == "--") break;  // what follows are no options
    if (name.starts_with("--") && std::find(known.begin(), known.end(), name) == known.end()) return meant(name, known);
  }
  return "";
}

}  // namespace carom::cli
