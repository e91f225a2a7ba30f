// SPDX-License-Identifier: MIT
// Broken input, wrong usage, and outcomes that are not a success: exit codes, and who says what where.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/run_command.h"
#include "tests/cli/stacked_boxes.h"

namespace carom::test {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

const Names kCommands = {"simulate", "gradient", "check", "edit", "export", "validate", "info"};

Names wordsFor(const std::string& command, const std::string& path) {
  if (command == "export") return {command, path, "-o", temporaryPath("never.svg")};
  return {command, path};
}

json exampleScene(const std::string& name) { return json::parse(readText(scenePath(name))); }

json twoBalls(double distance) {
  const json ball = {{"sphere", {{"radius", 0.1}}}};
  return {{"carom", 1},
          {"bodies",
           {{{"name", "a"}, {"mass", 1}, {"shape", ball}},
            {{"name", "b"}, {"mass", 1}, {"shape", ball}, {"position", {distance, 0, 0}}}}}};
}

struct Broken {
  const char* name;
  std::string (*path)();
  const char* pointer;  ///< in the JSON error
  const char* message;  ///< a part of it
};
std::ostream& operator<<(std::ostream& out, const Broken& row) { return out << row.name; }

class BrokenInput : public testing::TestWithParam<Broken> {};

TEST_P(BrokenInput, EndsEveryCommandWithOneAndAMessage) {
  const std::string path = GetParam().path();
  for (const std::string& command : kCommands) {
    SCOPED_TRACE(command);
    const CommandRun text = runCommand(wordsFor(command, path));
    EXPECT_EQ(text.code, 1);
    EXPECT_EQ(text.out, "");
    EXPECT_NE(text.err.find("carom: " + path + ": "), std::string::npos) << text.err;
    EXPECT_NE(text.err.find(GetParam().message), std::string::npos) << text.err;
    const json answer = runJson(wordsFor(command, path), 1);
    ASSERT_EQ(membersOf(answer), Names{"error"});
    EXPECT_EQ(membersOf(answer["error"]), (Names{"file", "message", "pointer"}));
    EXPECT_EQ(answer["error"]["file"], path);
    EXPECT_EQ(answer["error"]["pointer"], GetParam().pointer);
  }
  EXPECT_FALSE(std::filesystem::exists(temporaryPath("never.svg")));
}

INSTANTIATE_TEST_SUITE_P(
    Table, BrokenInput,
    testing::Values(
        Broken{"Missing", [] { return temporaryPath("missing.json"); }, "", "no such file"},
        Broken{"Folder", [] { return std::filesystem::path(temporaryPath("x")).parent_path().string(); }, "", "folder"},
        Broken{"Empty", [] { return writeTemporary("empty.json", ""); }, "", "line 1"},
        Broken{"Truncated",
               [] { return writeTemporary("half.json", readText(scenePath("book-on-shelf")).substr(0, 300)); }, "",
               "line "},
        Broken{"Binary", [] { return writeTemporary("binary.json", std::string("\0\xff\xfe\x01", 4)); }, "", "line 1"},
        Broken{"OtherVersion", [] { return writeTemporary("version.json", R"({"carom": 7, "bodies": []})"); }, "/carom",
               "7"},
        Broken{"Typo",
               [] {
                 json scene = exampleScene("ball-over-wall");
                 scene["durration"] = 2;
                 return writeTemporary("typo.json", scene.dump());
               },
               "/durration", "durration"},
        Broken{"NegativeMass",
               [] {
                 json scene = twoBalls(1);
                 scene["bodies"][1]["mass"] = -2;
                 return writeTemporary("mass.json", scene.dump());
               },
               "/bodies/1/mass", "-2"}),
    [](const auto& test) { return test.param.name; });

// Bodies that overlap at the start are told of once, or refused.
TEST(Errors, Overlaps) {
  const std::string path = writeTemporary("overlap.json", twoBalls(0.15).dump());
  const CommandRun run = runCommand({"simulate", path});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.out.find("'a' and 'b' overlap by 0.05 m at the start and do not separate"), std::string::npos) << run.out;
  const json answer = runJson({"simulate", path});
  ASSERT_EQ(answer["overlaps"].size(), 1u);
  EXPECT_EQ(answer["overlaps"][0]["bodies"], json({"a", "b"}));
  EXPECT_TRUE(answer["overlaps"][0]["parted"].is_null());
  EXPECT_EQ(runJson({"info", path})["overlaps"].size(), 1u);
  const CommandRun valid = runCommand({"validate", path});
  EXPECT_EQ(valid.code, 0);
  EXPECT_NE(valid.err.find("overlap by 0.05 m at the start"), std::string::npos) << valid.err;
  for (const char* command : {"simulate", "validate", "gradient", "edit"}) {
    const json refused = runJson({command, path, "--refuse-overlaps"}, 1);
    EXPECT_EQ(refused["error"]["pointer"], "/bodies/1") << command;
    EXPECT_NE(refused["error"]["message"].get<std::string>().find("overlapping"), std::string::npos) << refused;
  }
}

TEST(Errors, RepairedMeshes) {
  writeTemporary("turned.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n");
  const std::string path = writeTemporary(
      "repaired.json",
      R"({"carom": 1, "bodies": [{"name": "a", "density": 1, "shape": {"mesh": {"file": "turned.obj"}}}]})");
  for (const char* command : {"simulate", "validate", "info"}) {
    const CommandRun run = runCommand({command, path});
    EXPECT_EQ(run.code, 0) << command;
    EXPECT_NE(run.err.find("turned.obj was repaired: 1 triangle turned over"), std::string::npos) << run.err;
    if (std::string(command) == "info") continue;
    const json refused = runJson({command, path, "--strict"}, 1);
    EXPECT_NE(refused["error"]["message"].get<std::string>().find("turned.obj in need of repair"), std::string::npos) << refused;
  }
  for (const char* command : {"validate", "info"}) {
    const json answer = runJson({command, path});
    ASSERT_EQ(answer["repairs"].size(), 1u);
    EXPECT_NE(answer["repairs"][0]["what"].get<std::string>().find("1 triangle turned over"), std::string::npos);
  }
}

// Constraints that the motion does not have: an error for everything that needs them.
class MissingTarget : public testing::TestWithParam<std::string> {};
TEST_P(MissingTarget, NamesTheConstraint) {
  json scene = exampleScene("book-on-shelf");
  scene["constraints"][0]["at"] = {{"impact", 40}, {"with", "floor"}};
  const std::string path = writeTemporary("never-comes.json", scene.dump());
  const json answer = runJson({GetParam(), path}, 1);
  EXPECT_EQ(answer["error"]["pointer"], "/constraints/0/at");
  EXPECT_NE(answer["error"]["message"].get<std::string>().find("expected one that comes: it has "), std::string::npos)
      << answer;
}
INSTANTIATE_TEST_SUITE_P(Commands, MissingTarget, testing::Values("gradient", "check", "validate"));

TEST(Errors, AnEditThatFindsNoWayToAnImpactSaysWhichIsMissing) {
  json scene = exampleScene("book-on-shelf");
  scene["constraints"][0]["at"] = {{"impact", 40}, {"with", "floor"}};
  const json answer = runJson({"edit", writeTemporary("never-comes.json", scene.dump()), "--effort", "fast"}, 3);
  EXPECT_EQ(answer["status"], "not_converged");
  EXPECT_NE(answer["message"].get<std::string>().find("mpact 40 with 'floor'"), std::string::npos) << answer["message"];
}

TEST(Errors, GradientNeedsControlsAndConstraints) {
  const std::string path = writeTemporary("nothing-asked.json", twoBalls(1).dump());
  for (const char* command : {"gradient", "check"})
    EXPECT_EQ(runJson({command, path}, 1)["error"]["pointer"], "/controls") << command;
}

TEST(Errors, TimesBeyondTheEndAreNamed) {
  for (const char* time : {"5", "-1", "nan", "inf"}) {
    const CommandRun run = runCommand({"simulate", scenePath("ball-over-wall"), "--at", time});
    EXPECT_EQ(run.code, 1) << time;
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("--at"), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("expected one in [0, 1.4]"), std::string::npos) << run.err;
  }
}

TEST(Errors, OutputThatCannotBeWritten) {
  const std::string nowhere = temporaryPath("no-such-folder") + "/out";
  const std::string scene = scenePath("ball-over-wall");
  for (const Names& words :
       {Names{"export", scene, "-o", nowhere + ".glb"}, Names{"export", scene, "-o", nowhere + ".svg"},
        Names{"edit", scene, "-o", nowhere + ".json"}}) {
    EXPECT_EQ(runCommand(words).out, "");
    const json answer = runJson(words, 1);
    EXPECT_EQ(answer["error"]["file"], words[3]) << answer;
    EXPECT_NE(answer["error"]["message"], "");
  }
}

class WrongUsage : public testing::TestWithParam<Names> {};
TEST_P(WrongUsage, EndsWithTwo) {
  const CommandRun run = runCommand(GetParam());
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("carom: ", 0), 0u) << run.err;
  Names words = GetParam();
  EXPECT_EQ(membersOf(runJson(words, 2)), Names{"error"});
}
INSTANTIATE_TEST_SUITE_P(
    Table, WrongUsage,
    testing::Values(Names{}, Names{"smulate"}, Names{"simulate"}, Names{"simulate", "a.json", "b.json"},
                    Names{"simulate", "a.json", "--at"}, Names{"simulate", "a.json", "--at", "soon"},
                    Names{"simulate", "a.json", "--digits", "0"}, Names{"simulate", "a.json", "--unknown"},
                    Names{"gradient", "a.json", "--method", "guess"}, Names{"export", "a.json"},
                    Names{"export", "a.json", "-o", "a.obj"}, Names{"export", "a.json", "-o", "noextension"},
                    Names{"export", "a.json", "-o", "a.glb", "--profile", "maya"},
                    Names{"export", "a.json", "-o", "a.glb", "--fps", "0"},
                    Names{"export", "a.json", "-o", "a.glb", "--fps", "nan"},
                    Names{"export", "a.json", "-o", "a.svg", "--profile", "web"},
                    Names{"export", "a.json", "-o", "a.glb", "--before", "b.json"},
                    Names{"edit", "a.json", "--iterations", "0"}, Names{"edit", "a.json", "--seconds", "-1"}));

TEST(Outcomes, AnInfeasibleEditEndsWithThreeAndWritesNothing) {
  json scene = exampleScene("two-balls");
  json held = scene["constraints"][0], other = held;
  held["position"] = {0, 0, 5000}, other["position"] = {0, 0, 4000};  // one number at two values
  scene["constraints"] = {held, other};
  scene["controls"] = {{{"vary", "elasticity"}, {"material", scene["materials"].begin().key()}}};
  const std::string path = writeTemporary("infeasible.json", scene.dump()),
                    output = temporaryPath("infeasible-out.json");
  const CommandRun run = runCommand({"edit", path, "-o", output});
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("was not written"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(output));
  const json answer = runJson({"edit", path, "-o", output}, 3);
  EXPECT_TRUE(answer["output"].is_null());
  EXPECT_EQ(answer["status"], "infeasible");
  EXPECT_NE(answer["message"], "");
}

TEST(Outcomes, AnEditThatIsCutShortEndsWithThree) {
  const json answer = runJson({"edit", scenePath("book-on-shelf"), "--seconds", "1e-9"}, 3);
  EXPECT_EQ(answer["status"], "out_of_time");
  EXPECT_NE(answer["message"], "");
}

/// A cube that lands flat on the floor: any turn makes it land otherwise.
json flatLanding(const char* vary) {
  return {{"carom", 1},
          {"duration", 0.6},
          {"materials", {{"m", {{"elasticity", 0.5}, {"friction", 0.5}}}}},
          {"bodies",
           {{{"name", "floor"},
             {"fixed", true},
             {"material", "m"},
             {"shape", {{"plane", {{"normal", {0, 0, 1}}, {"offset", 0}}}}}},
            {{"name", "cube"},
             {"material", "m"},
             {"mass", 1},
             {"shape", {{"box", {{"size", {0.2, 0.2, 0.2}}}}}},
             {"position", {0, 0, 0.5}},
             {"velocity", {0.1, 0, 0}}}}},
          {"controls", {{{"vary", vary}, {"body", "cube"}}}},
          {"constraints", {{{"body", "cube"}, {"at", 0.5}, {"position", {0.1, 0, 0.2}}}}}};
}

TEST(Outcomes, ACheckSaysWhatItCannotCompare) {
  const std::string path = writeTemporary("flat.json", flatLanding("angular_velocity").dump());
  const json answer = runJson({"check", path}, 4);
  EXPECT_FALSE(answer["passed"].get<bool>());
  EXPECT_GT(answer["not_compared"].get<int>(), 0);
  int skipped = 0;
  for (const json& column : answer["columns"]) {
    for (const json& step : column["steps"]) {
      if (step["compared"].get<bool>()) continue;
      ++skipped;
      EXPECT_TRUE(step.contains("why") && step.contains("sequence_below") && step.contains("sequence_above")) << step;
    }
  }
  EXPECT_GT(skipped, 0);
  const CommandRun run = runCommand({"check", path});
  EXPECT_EQ(run.code, 4);
  EXPECT_NE(run.err.find("were not compared with differences"), std::string::npos) << run.err;
}

// A ball without friction keeps its spin, whatever its floor does: what the passes find of that is rounding.
TEST(Outcomes, ACheckTakesRoundingForNoDisagreement) {
  for (const double speed : {0.7, 1.3, 2.9}) {
    json scene = {{"carom", 1},
                  {"gravity", {0, 0, -10}},
                  {"duration", 0.8},
                  {"materials", {{"m", {{"elasticity", 0.6}, {"friction", 0}}}}},
                  {"bodies",
                   {{{"name", "floor"}, {"fixed", true}, {"material", "m"}, {"shape", {{"plane", {{"normal", {0, 0, 1}}, {"offset", 0}}}}}},
                    {{"name", "b"},
                     {"material", "m"},
                     {"mass", speed},
                     {"shape", {{"sphere", {{"radius", 0.11}}}}},
                     {"orientation", {0.5, 0.1, -0.7, 0.5}},
                     {"position", {0.3, 0.1, 1}},
                     {"velocity", {speed, -0.3, 0.2}},
                     {"angular_velocity", {3.1, -4.7, 5.3}}}}},
                  {"controls", {{{"vary", "mass"}, {"body", "b"}}, {{"vary", "velocity"}, {"body", "b"}}}},
                  {"constraints", {{{"body", "b"}, {"at", 0.7}, {"angular_velocity", {0, 0, 0}}}}}};
    const json answer = runJson({"check", writeTemporary("spin.json", scene.dump())});
    EXPECT_TRUE(answer["passed"].get<bool>()) << answer["message"];
  }
}

TEST(Outcomes, AGradientThroughAJointImpactIsNotCalledReliable) {
  const json answer = runJson({"gradient", writeTemporary("flat.json", flatLanding("velocity").dump())});
  EXPECT_FALSE(answer["reliable"].get<bool>());
  EXPECT_NE(answer["message"].get<std::string>().find("joins several contacts"), std::string::npos)
      << answer["message"];
}

TEST(Outcomes, AMotionThatEndsEarlySaysSo) {
  json scene = twoBalls(1);
  scene["duration"] = 20;
  scene["gravity"] = {0, 0, -9.81};
  addStackedBoxes(scene, 1);
  const std::string path = writeTemporary("stacked.json", scene.dump());
  const json answer = runJson({"simulate", path}, 5);
  EXPECT_EQ(answer["status"], "unresolved_contact");
  EXPECT_EQ(runCommand({"simulate", path}).code, 5);
  EXPECT_EQ(runCommand({"export", path, "-o", temporaryPath("early.svg")}).code, 5);
  EXPECT_TRUE(std::filesystem::exists(temporaryPath("early.svg")));
  EXPECT_NE(answer["message"].get<std::string>().find("1 of them impacts; they move on each other with 9 bodies"), std::string::npos)
      << answer["message"];
  EXPECT_LT(answer["end"].get<double>(), 20);
  EXPECT_EQ(answer["states"][0]["time"], answer["end"]);
  const CommandRun run = runCommand({"simulate", path, "--json"});
  EXPECT_NE(run.err.find("warning"), std::string::npos) << run.err;
  EXPECT_EQ(runCommand({"simulate", path, "--at", "15"}).code, 1);
}

}  // namespace
}  // namespace carom::test
