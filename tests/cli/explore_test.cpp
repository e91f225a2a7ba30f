// SPDX-License-Identifier: MIT
// carom explore: what it prints and writes, stores, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::string& throwPath() {
  static const std::string path = scenePath("uncertain-throw");
  return path;
}

TEST(Explore, CountsEveryWorldOnce) {
  const json answer = runJson({"explore", throwPath(), "--worlds", "2000", "--nearest", "3"});
  EXPECT_EQ(answer["worlds"], 2000);
  std::uint64_t worlds = 0;
  for (const json& outcome : answer["outcomes"]) {
    worlds += outcome["share"]["worlds"].get<std::uint64_t>();
    EXPECT_LE(outcome["share"]["lower"], outcome["share"]["share"]);
    EXPECT_GE(outcome["share"]["upper"], outcome["share"]["share"]);
  }
  EXPECT_EQ(worlds + answer["outside"].get<std::uint64_t>(), 2000u);
  EXPECT_EQ(answer["rows"][0]["name"], "position.x of 'ball' at its impact 1 with 'floor'");
  EXPECT_EQ(answer["rows"][0]["within"], answer["met"]);
  EXPECT_EQ(answer["nearest"].size(), 3u);
  EXPECT_EQ(answer["nearest"][0]["distance"], 0);
  EXPECT_EQ(answer["numbers"].size(), 7u);
  const CommandRun text = runCommand({"explore", throwPath(), "--worlds", "300"});
  EXPECT_EQ(text.code, 0);
  for (const char* part :
       {"300 worlds, 7 numbers drawn of each", "95 % interval [%]", "All ranges kept to", "in [1.8, 2.1]"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
}

TEST(Explore, ThreadsAndAStoreGiveTheSameTable) {
  const std::string folder = temporaryPath("store"), one = temporaryPath("one.worlds"),
                    two = temporaryPath("two.worlds"), csv = temporaryPath("table.csv");
  EXPECT_EQ(runCommand({"explore", throwPath(), "--worlds", "1500", "--gradients", "--threads", "1", "-o", one}).code,
            0);
  const auto stored = [&] {
    return runCommand({"explore", throwPath(), "--worlds", "1500", "--gradients", "--store", folder, "--chunk", "200",
                       "-o", two})
        .code;
  };
  EXPECT_EQ(stored(), 0);
  EXPECT_EQ(readText(one), readText(two));
  const fs::path chunks = fs::directory_iterator(folder)->path();
  fs::resize_file(chunks / "worlds-200-200", 100);
  fs::remove(chunks / "worlds-0-200");
  EXPECT_EQ(stored(), 0);
  EXPECT_EQ(readText(one), readText(two));
  EXPECT_EQ(fs::file_size(chunks / "worlds-200-200"), fs::file_size(chunks / "worlds-400-200"));
  EXPECT_EQ(runCommand({"explore", throwPath(), "--worlds", "20", "-o", csv}).code, 0);
  const std::string table = readText(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 21);
  const CommandRun piped = runCommand({"explore", throwPath(), "--worlds", "20", "-o", "-"});
  EXPECT_EQ(piped.out, table);
}

TEST(Explore, TheNearestWorldIsAStartForAnEdit) {
  const std::string near = temporaryPath("near.json");
  EXPECT_EQ(runCommand({"explore", throwPath(), "--worlds", "200", "--points", "sobol", "--start", near}).code, 0);
  EXPECT_EQ(runJson({"edit", near})["status"], "solved");
}

// Every world fails: rows all the same, and no start.
TEST(Explore, WorldsThatFailAreCounted) {
  json scene = json::parse(readText(throwPath()));
  scene["bodies"][2]["inertia"] = {2e-5, 2e-5, 2e-5};
  scene["controls"] = {{{"vary", "inertia"},
                        {"body", "ball"},
                        {"distribution", {{"uniform", {{"from", {1e-5, 1e-5, 1}}, {"to", {2e-5, 2e-5, 2}}}}}}}};
  const std::string path = writeTemporary("failing.json", scene.dump());
  const json answer = runJson({"explore", path, "--worlds", "50"});
  EXPECT_EQ(answer["outcomes"].size(), 1u);
  EXPECT_EQ(answer["outcomes"][0]["status"], "invalid_scene");
  EXPECT_EQ(answer["outcomes"][0]["share"]["worlds"], 50);
  EXPECT_EQ(runCommand({"explore", path, "--worlds", "50", "--start", temporaryPath("none.json")}).code, 3);
}

TEST(Explore, RefusesWhatMakesNoSense) {
  EXPECT_EQ(runCommand({"explore", throwPath(), "--worlds", "0"}).code, 2);
  EXPECT_EQ(runCommand({"explore", throwPath(), "--points", "grid"}).code, 2);
  EXPECT_EQ(runCommand({"explore", throwPath(), "-o", "-", "--start", "-"}).code, 2);
  const CommandRun without = runCommand({"explore", scenePath("two-balls")});
  EXPECT_EQ(without.code, 1);
  EXPECT_NE(without.err.find("/controls: found no \"distribution\""), std::string::npos) << without.err;
  json scene = json::parse(readText(throwPath()));
  scene["controls"][2]["distribution"] = {{"uniform", {{"from", 1}, {"to", 2}}}};
  const CommandRun outside = runCommand({"explore", writeTemporary("outside.json", scene.dump())});
  EXPECT_EQ(outside.code, 1);
  EXPECT_NE(outside.err.find("/controls/2/distribution/uniform: found nothing of the distribution"), std::string::npos)
      << outside.err;
  scene["controls"][2]["distribution"] = {{"gaussian", {{"deviation", 1}}}};
  const CommandRun unknown = runCommand({"explore", writeTemporary("unknown.json", scene.dump())});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.err.find("/controls/2/distribution"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace carom::test
