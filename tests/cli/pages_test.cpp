// SPDX-License-Identifier: MIT
// The completions of shells and the man page: they hold all that --help declares, and shells and roff take them.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using Names = std::vector<std::string>;

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::set<std::string> found;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), regex); match != std::sregex_iterator(); ++match)
    found.insert((*match)[1]);
  return found;
}

/// The commands of `carom --help`.
std::set<std::string> commandNames() {
  const std::string help = runCommand({"--help"}).out;
  return matches(help.substr(help.find("Subcommands:")), "\n  ([a-z]+) +[A-Z]");
}

/// The long options that --help of a command names at the start of a line.
std::set<std::string> longOptions(const std::string& command) {
  return matches(runCommand({command, "--help"}).out, "\n  (?:-[a-z],)?--([a-z-]+)");
}

bool hasProgram(const std::string& name) { return runShell("command -v " + name).code == 0; }

std::string page(const Names& words) {
  const CommandRun run = runCommand(words);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return run.out;
}

/// What bash offers for the last of the words, in a folder with some files.
std::set<std::string> offered(const Names& words) {
  const std::filesystem::path folder = temporaryPath("completed");
  std::filesystem::create_directories(folder / "sub");
  for (const char* name : {"a scene.json", "b.json", "c.glb", "d.gltf", "e.svg"})
    writeText((folder / name).string(), "");
  writeText((folder / "script").string(), page({"completion", "bash"}));
  std::string line = "cd '" + folder.string() + "' && exec bash --norc -c '. ./script; COMP_WORDS=(carom";
  for (const std::string& word : words) line += " \"" + word + "\"";
  line += "); COMP_CWORD=" + std::to_string(words.size()) + "; _carom; printf \"%s\\n\" \"${COMPREPLY[@]}\"'";
  const CommandRun run = runShell(line);
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  std::set<std::string> all;
  std::istringstream in(run.out);
  for (std::string word; std::getline(in, word);)
    if (!word.empty()) all.insert(word);
  return all;
}
using Offer = std::set<std::string>;

TEST(Completion, OfEveryCommandAndOptionInEveryShell) {
  const std::set<std::string> commands = commandNames();
  EXPECT_GE(commands.size(), 11u);
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const std::string script = page({"completion", shell});
    for (const std::string& command : commands) {
      EXPECT_NE(script.find(command), std::string::npos) << shell << " " << command;
      for (const std::string& option : longOptions(command)) {
        const std::regex fish("__fish_seen_subcommand_from " + command + "'[^\n]* -l " + option + " ");
        const bool there = shell == "fish" ? std::regex_search(script, fish)
                                           : script.find("--" + option) != std::string::npos;
        EXPECT_TRUE(there) << shell << " " << command << " " << option;
      }
    }
  }
}

TEST(Completion, ShellsTakeTheScripts) {
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    if (!hasProgram(shell)) continue;
    const std::string path = writeTemporary("script", page({"completion", shell}));
    const CommandRun run = runShell(shell + " -n '" + path + "'");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "");
  }
}

TEST(Completion, BashOffersCommands) {
  EXPECT_EQ(offered({""}), commandNames());
  EXPECT_EQ(offered({"e"}), (Offer{"edit", "explore", "export"}));
  EXPECT_EQ(offered({"--v"}), Offer{"--version"});
}

TEST(Completion, BashOffersOptions) {
  for (const std::string& command : commandNames()) {
    Offer expected;
    for (const std::string& option : longOptions(command)) expected.insert("--" + option);
    EXPECT_EQ(offered({command, "--"}), expected) << command;
  }
  EXPECT_EQ(offered({"simulate", "b.json", "--im"}), Offer{"--impacts"});
}

TEST(Completion, BashOffersValues) {
  EXPECT_EQ(offered({"gradient", "b.json", "--method", ""}), (Offer{"adjoint", "tangent"}));
  EXPECT_EQ(offered({"gradient", "--method", "=", "t"}), Offer{"tangent"});  // as bash splits --method=t
  EXPECT_EQ(offered({"export", "b.json", "--format", "g"}), (Offer{"glb", "gltf"}));
  EXPECT_EQ(offered({"simulate", "--at", ""}), Offer{});
  EXPECT_EQ(offered({"completion", ""}), (Offer{"bash", "zsh", "fish"}));
}

TEST(Completion, BashOffersFilesOfTheKindThatIsRead) {
  EXPECT_EQ(offered({"simulate", ""}), (Offer{"a scene.json", "b.json", "sub"}));
  EXPECT_EQ(offered({"import", ""}), (Offer{"c.glb", "d.gltf", "sub"}));
  EXPECT_EQ(offered({"export", "b.json", "--light", ""}), (Offer{"a scene.json", "b.json", "sub"}));
  EXPECT_EQ(offered({"export", "-o", ""}),
            (Offer{"a scene.json", "b.json", "c.glb", "d.gltf", "e.svg", "script", "sub"}));
  EXPECT_EQ(offered({"simulate", "b"}), Offer{"b.json"});
}

TEST(Completion, WrongShellsAreRefused) {
  EXPECT_EQ(runCommand({"completion", "tcsh"}).code, 2);
  EXPECT_EQ(runCommand({"completion"}).code, 2);
}

TEST(Man, HasEveryCommandAndOption) {
  std::string text = page({"man"});
  text = std::regex_replace(text, std::regex(R"(\\-)"), "-");
  for (const std::string& command : commandNames()) {
    const std::size_t start = text.find(".SS carom " + command + "\n");
    ASSERT_NE(start, std::string::npos) << command;
    const std::string own = text.substr(start, text.find("\n.S", start + 1) - start);
    for (const std::string& option : longOptions(command)) {
      if (option == "help") continue;
      const std::string bold = "\\fB--" + option + "\\fR";
      const bool common = option == "json" || option == "digits" || option == "quiet";
      EXPECT_NE((common ? text : own).find(bold), std::string::npos) << command << " --" << option;
    }
  }
  for (const char* heading : {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "COMMANDS", "NOTES", "EXIT STATUS"})
    EXPECT_NE(text.find(std::string("\n.SH ") + heading + "\n"), std::string::npos) << heading;
  EXPECT_NE(text.find("NO_COLOR"), std::string::npos);
}

TEST(Man, RoffTakesIt) {
  const std::string path = writeTemporary("carom.1", page({"man"}));
  if (hasProgram("groff")) {
    const CommandRun run = runShell("groff -man -ww -z -Tutf8 '" + path + "'");
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    const std::string shown = runShell("groff -man -Tascii -P-c -P-b -P-u '" + path + "'").out;
    EXPECT_NE(shown.find("carom edit scene.json -o - | carom export - --format svg"), std::string::npos) << shown;
  }
  if (hasProgram("mandoc")) {
    const CommandRun run = runShell("mandoc -T lint -W error '" + path + "'");
    EXPECT_EQ(run.code, 0) << run.out;
  }
  for (const char c : readText(path)) ASSERT_TRUE(c == '\n' || (c >= ' ' && c <= '~'));
}

TEST(Man, FilesAreWritten) {
  const std::string path = temporaryPath("written.1");
  EXPECT_EQ(page({"man", "-o", path}), "");
  EXPECT_EQ(readText(path), page({"man", "-o", "-"}));
  EXPECT_EQ(readText(path), page({"man"}));
  const CommandRun nowhere = runCommand({"man", "-o", temporaryPath("no-such-folder") + "/x"});
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_NE(nowhere.err.find("cannot write"), std::string::npos) << nowhere.err;
}

}  // namespace
}  // namespace carom::test
