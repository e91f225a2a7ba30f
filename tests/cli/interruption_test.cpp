// SPDX-License-Identifier: MIT
// Ctrl-C, SIGTERM, the limit of work, and outputs that cannot be written, as the command has them.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <regex>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;

/// Balls without gravity that fly on for 1e9 s: seconds of work.
std::string longScene() {
  json bodies = json::array();
  unsigned state = 1;
  const auto next = [&](double size) {
    state = state * 1664525u + 1013904223u;
    return size * (static_cast<double>(state >> 8) / (1 << 24) - 0.5);
  };
  for (int i = 0; i < 4000; ++i)
    bodies.push_back({{"name", "b" + std::to_string(i)},
                      {"mass", 1},
                      {"shape", {{"sphere", {{"radius", 0.05}}}}},
                      {"position", {next(40), next(40), next(40)}},
                      {"velocity", {next(20), next(20), next(20)}}});
  const json scene = {{"carom", 1}, {"duration", 1e9}, {"gravity", {0, 0, 0}}, {"bodies", bodies}};
  return writeTemporary("long.json", scene.dump());
}

/// Runs the command and sends it a signal after a while.
CommandRun signalled(const std::string& signal, double seconds, const std::string& words) {
  return runShell("timeout --foreground -s " + signal + " --preserve-status " + std::to_string(seconds) + " carom " + words);
}

TEST(Interruption, SimulateSaysHowFarItCame) {
  const std::string scene = "'" + longScene() + "'";
  for (const auto& [signal, code] : {std::pair<std::string, int>{"INT", 130}, {"TERM", 143}}) {
    const auto began = std::chrono::steady_clock::now();
    const CommandRun run = signalled(signal, 0.7, "simulate " + scene + " --step-limit 1000000000 --json");
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (run.code == 0) continue;  // a machine that was done by then
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_LT(seconds, 10) << "does not stop";
    const json answer = json::parse(run.out, nullptr, false);
    ASSERT_FALSE(answer.is_discarded()) << run.out.substr(0, 300);
    EXPECT_EQ(answer["status"], "stopped");
    EXPECT_NE(answer["message"].get<std::string>().find("as requested"), std::string::npos);
  }
}

TEST(Interruption, OtherCommandsEndWithASentence) {
  const std::string out = temporaryPath("never.glb");
  const CommandRun run = signalled("INT", 0.7, "export '" + longScene() + "' --step-limit 1000000000 -o '" + out + "'");
  if (run.code != 1) {  // else the motion was known by then, and is too long to be written
    EXPECT_EQ(run.code, 130) << run.err;
    EXPECT_NE(run.err.find("stopped at t = "), std::string::npos) << run.err;
  }
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Interruption, EditKeepsTheBest) {
  const std::string out = temporaryPath("best.json");
  const CommandRun run = signalled(
      "INT", 0.4, "edit '" + scenePath("mug-on-mark") + "' --alternatives 60 --threads 1 --json -o '" + out + "'");
  const json answer = json::parse(run.out, nullptr, false);
  ASSERT_FALSE(answer.is_discarded()) << run.code << run.err;
  EXPECT_TRUE(run.code == 130 || run.code == 0) << run.code << run.err;
  EXPECT_TRUE(answer["status"] != "cancelled" || run.code == 130) << run.code;
  EXPECT_TRUE(answer["status"] == "cancelled" || answer["status"].get<std::string>().starts_with("solved"));
  EXPECT_EQ(std::filesystem::exists(out), !answer["output"].is_null());
  if (answer["met"]) {
    EXPECT_LE(answer["scaled_residual"].get<double>(), 1e-9);
    EXPECT_TRUE(std::filesystem::exists(out));
  }
}

/// A search that goes on for long, and an edit that is solved at once and whose report simulates 1e9 s.
std::string editOfLongMotion() {
  json scene = json::parse(readText(longScene()));
  const json& place = scene["bodies"][0]["position"];
  scene["controls"] = {{{"vary", "velocity"}, {"body", "b0"}}};
  scene["constraints"] = {{{"body", "b0"}, {"at", 0.001}, {"position", {place[0], place[1], place[2]}}}};
  return "edit '" + writeTemporary("long-edit.json", scene.dump()) + "' --step-limit 1000000000";
}

/// Sends two signals, and says with which code the command ended; the shell has jobs, which hear of SIGINT.
CommandRun signalledTwice(const std::string& signal, double first, double second, const std::string& words) {
  const std::string script = "set -m; carom " + words + " & job=$!; sleep " + std::to_string(first) + "; kill -" + signal +
                             " $job; sleep " + std::to_string(second) + "; kill -" + signal +
                             " $job 2>/dev/null; wait $job; exit $?";
  return runShell("exec bash -c \"" + std::regex_replace(script, std::regex("[$]"), "\\$$") + "\"");
}

TEST(Interruption, ASecondSignalEndsAnEditAtOnce) {
  for (const auto& [signal, code] : {std::pair<std::string, int>{"INT", 130}, {"TERM", 143}}) {
    for (const double first : {0.05, 0.4, 1.2}) {  // while it reads, searches, simulates what it found
      const auto began = std::chrono::steady_clock::now();
      const CommandRun run = signalledTwice(signal, first, 0.2, editOfLongMotion());
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
      EXPECT_EQ(run.code, code) << run.out << run.err;
      EXPECT_LT(seconds, first + 5) << "does not end";
      EXPECT_EQ(run.out.find("held"), std::string::npos) << "has an answer";
    }
    const std::string words = "edit '" + scenePath("mug-on-mark") + "' --alternatives 60 --threads 1";
    for (const double first : {0.1, 0.3, 0.6, 1.0}) {
      const int ended = signalledTwice(signal, first, 0.02, words).code;
      EXPECT_TRUE(ended == code || ended == 0) << ended;  // 0: a machine that was done by then
    }
  }
}

TEST(StepLimit, EndsAMotionWithASentence) {
  const json answer = runJson({"simulate", scenePath("pen_500"), "--step-limit", "3000"}, 5);
  EXPECT_EQ(answer["status"], "step_limit");
  EXPECT_NE(answer["message"].get<std::string>().find("3000 steps"), std::string::npos);
  for (const std::string wrong : {"0", "-1", "many"})
    EXPECT_EQ(runCommand({"simulate", scenePath("two-balls"), "--step-limit", wrong}).code, 2);
  const CommandRun gradient = runCommand({"gradient", scenePath("two-balls"), "--step-limit", "1"});
  EXPECT_EQ(gradient.code, 1);
  EXPECT_NE(gradient.err.find(" steps, the limit"), std::string::npos) << gradient.err;
}

TEST(Output, IsAskedForBeforeTheWork) {
  const std::string scene = scenePath("two-balls");
  const std::string nowhere = temporaryPath("none") + "/out.json";
  for (const std::vector<std::string>& words : {std::vector<std::string>{"edit", temporaryPath("missing.json"), "-o", nowhere},
                                                {"export", temporaryPath("missing.json"), "--format", "csv", "-o", nowhere},
                                                {"replay", temporaryPath("missing.json"), "-o", nowhere},
                                                {"import", temporaryPath("missing.glb"), "-o", nowhere}}) {
    const CommandRun run = runCommand(words);
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("none/out.json: cannot write the file: No such file"), std::string::npos) << run.err;
  }
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"edit", scene, "-o", ""}, {"export", scene, "-o", ""}, {"man", "-o", ""}}) {
    const CommandRun run = runCommand(words);
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("found an empty name"), std::string::npos) << run.err;
  }
  EXPECT_EQ(runCommand({"edit", scene, "-o", "/dev/null"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Output, OfALongMotionIsRefusedBeforeItFillsTheMemory) {
  json scene = json::parse(readText(scenePath("two-balls")));
  scene["duration"] = 1e9;
  scene.erase("constraints"), scene.erase("controls");
  const std::string path = writeTemporary("years.json", scene.dump());
  for (const std::string format : {"csv", "py", "glb", "gltf"}) {
    const CommandRun run = runCommand({"export", path, "--format", format, "-o", temporaryPath("years")});
    if (run.code == 0) continue;  // straight flights need few keys
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("at most "), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(temporaryPath("years")));
  }
  EXPECT_EQ(runCommand({"export", path, "--format", "csv", "-o", temporaryPath("years")}).code, 1);
}

}  // namespace
}  // namespace carom::test
