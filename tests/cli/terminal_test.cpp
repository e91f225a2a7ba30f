// SPDX-License-Identifier: MIT
// Colour and progress: only on a terminal, and not against the person's will.
#include <gtest/gtest.h>

#include <regex>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;

/// What a terminal was sent, without the colours.
std::string withoutColours(const std::string& text) {
  return std::regex_replace(text, std::regex("\033\\[[0-9;]*m"), "");
}

std::string withoutReturns(std::string text) {
  std::erase(text, '\r');
  return text;
}

std::string shortScene() { return scenePath("ball-over-wall"); }

/// Takes a second or so.
const std::vector<std::string> kLongWork{"edit", scenePath("mug-on-mark"), "--alternatives", "20", "--threads", "1"};

TEST(Colour, OnATerminalOnly) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"simulate", shortScene()},
        {"check", shortScene()},
        {"gradient", shortScene()},
        {"info", shortScene()}}) {
    const CommandRun plain = runCommand(words), seen = runOnTerminal(Terminal::out, words);
    EXPECT_EQ(seen.code, 0);
    EXPECT_EQ(plain.out.find('\033'), std::string::npos) << words[0];
    EXPECT_NE(seen.out.find("\033[1m"), std::string::npos) << words[0] << "\n" << seen.out;
    EXPECT_EQ(withoutReturns(withoutColours(seen.out)), plain.out);
  }
}

TEST(Colour, NotWhereThePersonWantsNone) {
  const std::vector<std::string> words{"simulate", shortScene()};
  EXPECT_EQ(runOnTerminal(Terminal::out, words, {"NO_COLOR=1"}).out.find('\033'), std::string::npos);
  EXPECT_EQ(runOnTerminal(Terminal::out, words, {"TERM=dumb"}).out.find('\033'), std::string::npos);
  EXPECT_NE(runOnTerminal(Terminal::out, words, {"NO_COLOR="}).out.find('\033'), std::string::npos);  // empty: not set
}

TEST(Colour, NeverInJson) {
  EXPECT_EQ(runOnTerminal(Terminal::out, {"simulate", shortScene(), "--json"}).out.find('\033'), std::string::npos);
  EXPECT_EQ(runOnTerminal(Terminal::out, {"edit", shortScene(), "-o", "-"}).out.find('\033'), std::string::npos);
}

TEST(Colour, OfErrors) {
  const std::vector<std::string> words{"simulate", temporaryPath("missing.json")};
  EXPECT_EQ(runOnTerminal(Terminal::error, words).err.rfind("\033[1;31mcarom:\033[0m ", 0), 0u);
  EXPECT_EQ(runCommand(words).err.rfind("carom: ", 0), 0u);
}

TEST(Progress, SaysPhaseAndTimeAndHowFarItIs) {
  const CommandRun run = runOnTerminal(Terminal::error, kLongWork);
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(std::regex_search(run.err, std::regex("\rsolving, [0-9]+\\.[0-9] s: iteration [0-9]+, largest error")))
      << run.err;
  EXPECT_TRUE(run.err.ends_with("\r\033[K")) << "the line stays: " << run.err;
  EXPECT_EQ(run.out.find('\r'), std::string::npos);
}

TEST(Progress, IsSilentOtherwise) {
  EXPECT_EQ(runCommand(kLongWork).err, "");
  EXPECT_EQ(runOnTerminal(Terminal::out, kLongWork).err, "");
  std::vector<std::string> quiet = kLongWork;
  quiet.push_back("--quiet");
  EXPECT_EQ(runOnTerminal(Terminal::error, quiet).err, "");
}

// A sentence that people see on a terminal, where standard output and error come together, is there once.
TEST(Failures, AreSaidOnce) {
  json impossible = json::parse(readText(scenePath("two-balls")));
  impossible["constraints"][0]["position"] = {0, 0, 5000};
  impossible["controls"] = {{{"vary", "elasticity"}, {"material", impossible["materials"].begin().key()}}};
  const std::string path = writeTemporary("impossible.json", impossible.dump());
  const std::string message = runJson({"edit", path}, 3)["message"];
  const CommandRun run = runOnTerminal(Terminal::all, {"edit", path, "-o", temporaryPath("never.json")});
  EXPECT_EQ(run.code, 3);
  const std::string seen = withoutReturns(withoutColours(run.out));
  const std::size_t first = seen.find(message);
  ASSERT_NE(first, std::string::npos) << seen;
  EXPECT_EQ(seen.find(message, first + 1), std::string::npos) << seen;
  EXPECT_LT(seen.find("certificate:"), first) << "the failure is not below the tables: " << seen;
}

}  // namespace
}  // namespace carom::test
