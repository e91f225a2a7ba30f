// SPDX-License-Identifier: MIT
// Spans, ranges, other bodies' axes and regions, from a document through every command.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cli/run_command.h"
#include "tests/cli/stacked_boxes.h"

namespace carom::test {
namespace {

using nlohmann::json;

json ballAt(const std::string& name, const json& position, const json& velocity) {
  return {{"name", name},
          {"mass", 1},
          {"shape", {{"sphere", {{"radius", 0.1}}}}},
          {"position", position},
          {"velocity", velocity}};
}

/// A thrown ball that must pass a place high enough at some time, besides an obstacle, and a second one above it.
json sceneOfEveryConstraint() {
  json scene = {{"carom", 1}, {"duration", 1}};
  scene["bodies"] = {{{"name", "floor"}, {"fixed", true}, {"shape", {{"plane", {{"normal", {0, 0, 1}}}}}}},
                     ballAt("ball", {0, 0, 1}, {2, 0, 1}),
                     ballAt("other", {3, 2, 1}, {0, 0, 2})};
  scene["controls"] = {{{"vary", "velocity"}, {"body", "ball"}}, {{"vary", "velocity"}, {"body", "other"}}};
  scene["constraints"] = json::parse(R"([
    { "body": "ball", "at": { "between": [0.2, 0.8] }, "position": [1, null, { "min": 1.2, "max": 1.25 }] },
    { "body": "ball", "at": { "impact": 1, "with": "floor" }, "time": { "max": 0.95 } },
    { "body": "other", "at": 0.5, "relative_to": "ball", "position": [null, 1, { "min": 0.1 }] },
    { "body": "ball", "avoid": { "sphere": { "radius": 0.2 }, "position": [0.5, 0.05, 1.1], "during": [0, 0.6] } }
  ])");
  return scene;
}

std::string written(const json& scene) { return writeTemporary("constraints.json", scene.dump()); }

TEST(EveryConstraint, GradientTellsRangesAndTimes) {
  const json answer = runJson({"gradient", written(sceneOfEveryConstraint())});
  const json& rows = answer["rows"];
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0]["target"], 1);
  EXPECT_FALSE(rows[0].contains("min"));
  EXPECT_EQ(rows[1]["component"], "position.z");
  EXPECT_TRUE(rows[1]["target"].is_null());
  EXPECT_EQ(rows[1]["min"], 1.2);
  EXPECT_EQ(rows[1]["max"], 1.25);
  EXPECT_EQ(rows[2]["component"], "time");
  EXPECT_TRUE(rows[2]["min"].is_null());
  EXPECT_EQ(rows[2]["max"], 0.95);
  EXPECT_EQ(rows[5]["component"], "avoid");
  EXPECT_EQ(rows[5]["min"], 0);
  EXPECT_LT(rows[5]["value"].get<double>(), 0);  // the ball flies through it
  ASSERT_EQ(answer["times"].size(), 1u);
  EXPECT_EQ(membersOf(answer["times"][0]), (std::vector<std::string>{"constraint", "from", "time", "to"}));
  EXPECT_EQ(answer["times"][0]["constraint"], 0);
  EXPECT_EQ(answer["times"][0]["to"], 0.8);
  const CommandRun text = runCommand({"gradient", written(sceneOfEveryConstraint())});
  EXPECT_NE(text.out.find("in [1.2, 1.25]"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("<= 0.95"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find(">= 0"), std::string::npos) << text.out;
}

TEST(EveryConstraint, CheckComparesAtTheSameTimes) {
  const json answer = runJson({"check", written(sceneOfEveryConstraint())});
  EXPECT_TRUE(answer["passed"].get<bool>()) << answer["message"];
}

TEST(EveryConstraint, EditMeetsThemAndTellsWhen) {
  const std::string edited = temporaryPath("constraints-edited.json");
  const json answer = runJson({"edit", written(sceneOfEveryConstraint()), "-o", edited});
  ASSERT_EQ(answer["times"].size(), 1u);
  const json& met = answer["times"][0];
  EXPECT_EQ(met["name"], "'ball' between 0.2 s and 0.8 s");
  EXPECT_TRUE(met["time"].get<double>() >= 0.2 && met["time"].get<double>() <= 0.8) << met;
  for (const json& held : answer["residuals"]) EXPECT_TRUE(std::abs(held["error"].get<double>()) <= 1e-8) << held;
  const json moved = runJson({"simulate", edited, "--at", met["time"].dump()});
  EXPECT_NEAR(moved["states"][0]["bodies"]["ball"]["position"][0].get<double>(), 1, 1e-8);
  // Read again, the constraint between two times is met where it is nearest.
  const json gradient = runJson({"gradient", edited});
  EXPECT_NEAR(gradient["rows"][0]["value"].get<double>(), 1, 1e-8);
  EXPECT_GE(gradient["rows"][1]["value"].get<double>(), 1.2 - 1e-8);
  EXPECT_GE(gradient["rows"][5]["value"].get<double>(), -1e-8);

  const CommandRun text = runCommand({"edit", written(sceneOfEveryConstraint())});
  EXPECT_NE(text.out.find("in [1.2, 1.25]"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("'ball' between 0.2 s and 0.8 s: at "), std::string::npos) << text.out;
}

TEST(EveryConstraint, AreDrawnAndExported) {
  const std::string path = written(sceneOfEveryConstraint()), svg = temporaryPath("constraints.svg");
  runJson({"export", path, "-o", svg});
  const std::string picture = readText(svg);
  for (const char* part : {"class=\"nail-range\"", "class=\"avoid\"", "relative to ball", "(0.2 to 0.8 s)"})
    EXPECT_NE(picture.find(part), std::string::npos) << part;
  const std::string glb = temporaryPath("constraints.glb"), again = temporaryPath("constraints-again.json");
  runJson({"export", path, "-o", glb});
  runJson({"import", glb, "-o", again});
  const json found = json::parse(readText(again))["constraints"], expected = sceneOfEveryConstraint()["constraints"];
  EXPECT_EQ(found, expected);
}

/// A block that slides to a stop on a floor, 0.2936 m from where it starts.
json sceneOfRest() {
  json scene = {{"carom", 1}, {"duration", 3}, {"materials", {{"wood", {{"friction", 0.25}}}}}};
  scene["bodies"] = {
      {{"name", "floor"}, {"fixed", true}, {"material", "wood"}, {"shape", {{"plane", {{"normal", {0, 0, 1}}}}}}},
      {{"name", "block"}, {"material", "wood"}, {"mass", 1}, {"shape", {{"box", {{"size", {0.2, 0.2, 0.1}}}}}},
       {"position", {0, 0, 0.05}}, {"velocity", {1.2, 0, 0}}}};
  scene["controls"] = {{{"vary", "velocity"}, {"body", "block"}, {"components", {"x", "y"}}}};
  scene["constraints"] = json::parse(R"([{ "body": "block", "at": { "rest": true }, "position": [1, 0.2, null] }])");
  return scene;
}

TEST(ConstraintAtRest, EveryCommandReadsIt) {
  const std::string path = written(sceneOfRest());
  const json gradient = runJson({"gradient", path});
  ASSERT_EQ(gradient["rows"].size(), 2u);
  const double mu_g = 0.25 * 9.81;
  EXPECT_NEAR(gradient["rows"][0]["value"].get<double>(), 1.2 * 1.2 / (2 * mu_g), 1e-12);
  EXPECT_NEAR(gradient["jacobian"][0][0].get<double>(), 1.2 / mu_g, 1e-12);
  ASSERT_EQ(gradient["times"].size(), 1u);
  EXPECT_NEAR(gradient["times"][0]["time"].get<double>(), 1.2 / mu_g, 1e-12);
  EXPECT_EQ(gradient["times"][0]["to"], 3);
  EXPECT_NE(runCommand({"gradient", path}).out.find("of 'block' at rest: at 0.489297 s\n"), std::string::npos);
  const json check = runJson({"check", path});
  EXPECT_TRUE(check["passed"].get<bool>()) << check["message"];

  const std::string edited = temporaryPath("rest-edited.json");
  const json answer = runJson({"edit", path, "-o", edited});
  EXPECT_EQ(answer["status"], "solved");
  const json& changed = answer["changed"];
  const double length = std::hypot(1, 0.2), speed = std::sqrt(2 * mu_g * length);
  EXPECT_NEAR(changed[0]["after"].get<double>(), speed / length, 1e-9);
  EXPECT_NEAR(changed[1]["after"].get<double>(), 0.2 * speed / length, 1e-9);
  EXPECT_EQ(answer["times"][0]["name"], "'block' at rest");
  EXPECT_NEAR(answer["times"][0]["time"].get<double>(), speed / mu_g, 1e-9);
  EXPECT_EQ(json::parse(readText(edited))["constraints"], sceneOfRest()["constraints"]);
  const CommandRun text = runCommand({"edit", path});
  EXPECT_NE(text.out.find("'block' at rest: at 0.912 s"), std::string::npos) << text.out;
}

TEST(ConstraintAtRest, IsDrawnAndExported) {
  const std::string path = written(sceneOfRest()), svg = temporaryPath("rest.svg"), glb = temporaryPath("rest.glb"),
                    again = temporaryPath("rest-again.json");
  runJson({"export", path, "-o", svg});
  EXPECT_NE(readText(svg).find("block at rest"), std::string::npos);
  runJson({"export", path, "-o", glb});
  runJson({"import", glb, "-o", again});
  EXPECT_EQ(json::parse(readText(again))["constraints"], sceneOfRest()["constraints"]);
}

TEST(ConstraintAtRest, OneThatDoesNotComeIsNamed) {
  json scene = sceneOfRest();
  scene["materials"]["wood"]["friction"] = 0;
  const std::string path = written(scene);
  for (const char* command : {"gradient", "check", "validate"}) {
    const json answer = runJson({command, path}, 1);
    EXPECT_EQ(answer["error"]["pointer"], "/constraints/0/at/rest") << command;
    EXPECT_EQ(answer["error"]["message"], "'block' does not come to rest within 3 s.") << command;
  }
  const json edit = runJson({"edit", path, "--effort", "fast"}, 3);
  EXPECT_EQ(edit["status"], "not_converged");
  EXPECT_NE(edit["message"].get<std::string>().find("'block' does not come to rest within 3 s."), std::string::npos);
  const json stays = runJson({"edit", path, "--same-sequence"}, 1);
  EXPECT_EQ(stays["error"]["pointer"], "/constraints/0/at/rest");
}

TEST(ConstraintAtRest, WhatNeverRestsIsRefused) {
  json scene = sceneOfRest();
  scene["bodies"][1]["kinematic"] = true;
  const json answer = runJson({"edit", written(scene)}, 1);
  EXPECT_EQ(answer["error"]["pointer"], "/constraints/0/body");
  EXPECT_NE(answer["error"]["message"].get<std::string>().find("others never come to rest"), std::string::npos)
      << answer;
  scene = sceneOfRest();
  scene["constraints"][0]["velocity"] = {0, 0, 0};
  EXPECT_EQ(runJson({"validate", written(scene)}, 1)["error"]["pointer"], "/constraints/0/velocity");
}

struct Beyond {
  const char* name;
  const char* constraint;
  const char* pointer;
  const char* message;
};
std::ostream& operator<<(std::ostream& out, const Beyond& row) { return out << row.name; }

/// A motion that ends before its duration: what lies after that is not there.
class BeyondTheEnd : public testing::TestWithParam<Beyond> {};

TEST_P(BeyondTheEnd, IsNamed) {
  json scene = sceneOfEveryConstraint();
  scene["duration"] = 20;
  addStackedBoxes(scene, 1);
  scene["constraints"] = json::array({json::parse(GetParam().constraint)});
  const std::string path = written(scene);
  for (const char* command : {"gradient", "validate"}) {
    const json answer = runJson({command, path}, 1);
    EXPECT_EQ(answer["error"]["pointer"], GetParam().pointer) << command;
    EXPECT_NE(answer["error"]["message"].get<std::string>().find(GetParam().message), std::string::npos) << answer;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, BeyondTheEnd,
    testing::Values(Beyond{"Between", R"({"body": "ball", "at": {"between": [18, 19]}, "position": [1, null, null]})",
                           "/constraints/0/at/between/0", "found 18, expected a time up to "},
                    Beyond{"During", R"({"body": "ball", "avoid": {"sphere": {"radius": 1}, "during": [0, 19]}})",
                           "/constraints/0/avoid/during/1", "found 19, expected a time up to "},
                    Beyond{
                        "WholeMotion",
                        R"({"body": "ball", "inside": [{"sphere": {"radius": 99}}, {"box": {"size": [99, 99, 99]}}]})",
                        "/constraints/0/inside/0", "found a region of the whole motion, expected a time up to "}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace carom::test
