// SPDX-License-Identifier: MIT
// Help, versions, and options: in which order they stand, and what they change.
#include <gtest/gtest.h>

#include <utility>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

const Names kHelped = {"simulate", "gradient", "check", "edit", "export", "validate", "info"};

TEST(Help, EveryCommandExplainsItselfWithExamples) {
  const CommandRun all = runCommand({"--help"});
  EXPECT_EQ(all.code, 0);
  for (const std::string& command : kHelped) {
    EXPECT_NE(all.out.find("  " + command), std::string::npos) << command;
    const CommandRun one = runCommand({command, "--help"});
    EXPECT_EQ(one.code, 0);
    EXPECT_NE(one.out.find("Examples:\n  carom " + command), std::string::npos) << one.out;
    EXPECT_NE(one.out.find("--json"), std::string::npos);
  }
  EXPECT_NE(all.out.find("Exit codes"), std::string::npos);
}

TEST(Help, IsAskedForInSeveralWays) {
  for (const std::string& command : kHelped) {
    const std::string help = runCommand({command, "--help"}).out;
    EXPECT_EQ(runCommand({"help", command}).out, help);
    EXPECT_EQ(runCommand({"--help", command}).out, help);
  }
  EXPECT_EQ(runCommand({"help"}).out, runCommand({"--help"}).out);
  const CommandRun none = runCommand({"help", "simulat"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("found 'simulat', expected one of simulate, "), std::string::npos) << none.err;
}

TEST(Help, FailsOnAFullDisk) {
  for (const char* words : {"--help", "--version", "help edit", "man", "info"}) {
    const CommandRun run = runShell(std::string("carom ") + words + " > /dev/full");
    EXPECT_EQ(run.code, 1) << words;
    EXPECT_NE(run.err.find("standard output: cannot be written"), std::string::npos) << run.err;
  }
}

TEST(Help, SaysWhatWasMeant) {
  const std::pair<Names, const char*> table[] = {
      {{"simulat", "x.json"}, "did you mean simulate?"},
      {{"edti"}, "did you mean edit?"},
      {{"edit", scenePath("mug"), "--efort", "fast"}, "did you mean --effort?"},
      {{"simulate", scenePath("mug"), "--digit=3"}, "did you mean --digits?"},
      {{"--quite", "simulate", scenePath("mug")}, "did you mean --quiet?"}};
  for (const auto& [words, expected] : table) {
    const CommandRun run = runCommand(words);
    EXPECT_EQ(run.code, 2) << run.err;
    EXPECT_NE(run.err.find(expected), std::string::npos) << run.err;
  }
  EXPECT_EQ(runCommand({"xylophone"}).err.find("did you mean"), std::string::npos);
}

TEST(Options, StandInAnyOrder) {
  const std::string scene = scenePath("two-balls"), out = runCommand({"simulate", scene, "--digits", "3", "--at", "0.1"}).out;
  EXPECT_NE(out.find("State at 0.1 s"), std::string::npos) << out;
  EXPECT_EQ(runCommand({"simulate", "--at", "0.1", "--digits", "3", scene}).out, out);
  EXPECT_EQ(runCommand({"--digits", "3", "simulate", scene, "--at", "0.1"}).out, out);
  EXPECT_EQ(runCommand({"--digits=3", "--at", "0.1", "simulate", scene}).out, out);
  EXPECT_EQ(runCommand({"--json", "simulate", scene}).out, runCommand({"simulate", scene, "--json"}).out);
}

TEST(Help, VersionIsThatOfInfo) {
  const CommandRun version = runCommand({"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(runCommand({"-V"}).out, version.out);
  const json info = runJson({"info"});
  EXPECT_EQ(version.out, "carom " + info["version"].get<std::string>() + "\n");
  EXPECT_EQ(membersOf(info), (Names{"build", "compiler", "exports", "libraries", "scene_format", "version"}));
  EXPECT_NE(runCommand({"info"}).out.find("Ipopt 3."), std::string::npos);
}

TEST(Options, ChangeWhatIsExported) {
  const std::string scene = scenePath("ball-over-wall");
  const auto bytes = [&](Names extra, const std::string& file) {
    Names words{"export", scene, "-o", temporaryPath(file)};
    words.insert(words.end(), extra.begin(), extra.end());
    return runJson(words)["bytes"].get<int>();
  };
  const int plain = bytes({}, "a.glb");
  EXPECT_EQ(bytes({"--keys", "linear"}, "b.glb"), plain);
  EXPECT_LT(bytes({"--keys", "cubic"}, "b.glb"), plain);
  EXPECT_LT(bytes({"--tolerance", "0.002"}, "b.glb"), plain);
  EXPECT_LT(plain, bytes({"--fps", "240"}, "b.glb"));
  EXPECT_LT(plain, bytes({"--camera"}, "b.glb"));
  EXPECT_LT(plain, bytes({"--light"}, "b.glb"));
  EXPECT_LT(plain, bytes({"--ghosts", "0.1"}, "b.glb"));
  EXPECT_LT(plain, bytes({"--nails"}, "b.glb"));
  EXPECT_LT(4 * plain / 3, bytes({}, "b.py"));
  EXPECT_LT(bytes({"--fps", "10"}, "a.csv"), bytes({"--fps", "100"}, "b.csv"));
  EXPECT_LT(bytes({}, "a.svg"), bytes({"--before", scene}, "b.svg"));
}

}  // namespace
}  // namespace carom::test
