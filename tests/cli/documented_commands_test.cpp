// SPDX-License-Identifier: MIT
// Every command line of README.md and docs/*.md runs, in the order in which a reader meets them, in a folder with the scene of
// the README and the examples.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <regex>

#include "examples/support/project_file.h"
#include "tests/cli/run_command.h"
#include "tests/cli/short_session.h"

namespace carom::test {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

std::vector<std::string> pages() {
  std::vector<std::string> names{"README.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator(projectFile("docs")))
    if (entry.path().extension() == ".md" && entry.path().filename() != "decisions.md" &&
        entry.path().filename() != "tutorial.md")  // that one has files of its own: tutorial_test.cpp
      names.push_back("docs/" + entry.path().filename().string());
  std::sort(names.begin() + 1, names.end());
  return names;
}

/// The first block of code of a language.
std::string block(const std::string& page, const std::string& language) {
  const std::size_t fence = page.find("```" + language + "\n");
  if (fence == std::string::npos) return "";
  const std::size_t from = page.find('\n', fence) + 1;
  return page.substr(from, page.find("```", from) - from);
}

std::string replaced(const std::string& text, const char* pattern, const char* by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

/// As it can be typed: without its comment and what is optional, and with a document where the text leaves it out.
std::string typed(std::string line) {
  line = replaced(line, "\\s+#.*$", "");
  line = replaced(line, "\\s*\\[[^\\]]*\\]", "");
  line = replaced(line, "\\s+", " ");
  line = replaced(line, " +$", "");
  if (line.find(".json") != std::string::npos || line.find(" - ") != std::string::npos) return line;
  return replaced(line, "^carom (simulate|edit|gradient|check|info|validate|export) ", "carom $1 S.json ");
}

/// Lines of code blocks and code within sentences that call the command with arguments.
Lines commandsOf(const std::string& page) {
  Lines found;
  const std::regex code(
      "```[^`]*```|`(carom (?:simulate|edit|replay|gradient|check|export|import|info|validate|completion|man) [^`]+)`");
  for (auto match = std::sregex_iterator(page.begin(), page.end(), code); match != std::sregex_iterator(); ++match) {
    if ((*match)[1].matched) {
      found.push_back(typed((*match)[1]));
      continue;
    }
    const std::string text = match->str();
    const std::regex call("(^|\n)(?:\\$ )?(carom [a-z-][^\n]*)");
    for (auto line = std::sregex_iterator(text.begin(), text.end(), call); line != std::sregex_iterator(); ++line)
      found.push_back(typed((*line)[2]));
  }
  return found;
}

/// Pages are made with three.js, which not every machine has.
bool canRun(const std::string& line) {
  static const bool three = fs::exists(projectFile("studio/page/node_modules/three/build/three.module.js"));
  if (three || line.find(".html") == std::string::npos) return true;
  std::cout << "left out: " << line << " (scripts/setup studio)\n";
  return false;
}

TEST(DocumentedCommands, Run) {
  const fs::path folder = temporaryPath("documented");
  fs::create_directories(folder / "bin");
  fs::create_directory_symlink(projectFile("examples"), folder / "examples");
  fs::create_symlink(commandPath(), folder / "bin/carom");
  const std::string scene = block(readText(projectFile("README.md")), "json");
  ASSERT_NE(scene, "");
  for (const char* name : {"S.json", "OLD.json"}) writeText((folder / name).string(), scene);
  for (const char* name : {"J.json", "session.json"}) saveJournal((folder / name).string(), {shortSession(), ""});
  std::size_t count = 0;
  for (const std::string& name : pages()) {
    for (const std::string& line : commandsOf(readText(projectFile(name)))) {
      if (!canRun(line)) continue;
      const std::string log = (folder / "log").string();
      const std::string shell = "cd '" + folder.string() + "' && PATH=\"$PWD/bin:$PATH\" && export PATH && ( " + line +
                                " ) > '" + log + "' 2>&1 < /dev/null";
      EXPECT_EQ(std::system(shell.c_str()), 0) << name << ": " << line << "\n" << readText(log);
      ++count;
    }
  }
  EXPECT_GE(count, 15u) << "commands were not found in the pages";
}

}  // namespace
}  // namespace carom::test
