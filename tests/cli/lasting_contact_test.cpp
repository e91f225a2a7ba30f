// SPDX-License-Identifier: MIT
// What the command says of bodies that slide, roll and rest: to people, and with --json.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;

json bodyOf(const char* name, const json& shape, const json& position, const json& velocity) {
  return {{"name", name},   {"material", "m"},      {"mass", 1},
          {"shape", shape}, {"position", position}, {"velocity", velocity}};
}

/// A ball that bounces to rest, one that slides until it rolls, a block that slides to rest, and one that has always
/// rested.
std::string everyPath() {
  const json ball = {{"sphere", {{"radius", 0.1}}}}, block = {{"box", {{"size", {0.2, 0.2, 0.1}}}}};
  const json scene = {
      {"carom", 1},
      {"gravity", {0, 0, -9.81}},
      {"duration", 2},
      {"materials", {{"m", {{"elasticity", 0.4}, {"friction", 0.3}}}}},
      {"bodies",
       {bodyOf("drop", ball, {0, 0, 0.6}, {0, 0, 0}), bodyOf("bowl", ball, {0, 0.5, 0.1}, {0.8, 0, 0}),
        bodyOf("block", block, {0, -0.5, 0.05}, {1, 0, 0}), bodyOf("still", block, {-0.5, 0, 0.05}, {0, 0, 0}),
        {{"name", "floor"}, {"fixed", true}, {"material", "m"}, {"shape", {{"plane", {{"normal", {0, 0, 1}}}}}}}}}};
  return writeTemporary("every-path.json", scene.dump());
}

std::vector<std::string> linesWith(const std::string& text, const std::string& part) {
  std::vector<std::string> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.find(part) != std::string::npos) found.push_back(line);
  return found;
}

/// Without what aligns columns.
std::string wordsOf(const std::string& line) {
  std::istringstream in(line);
  std::string words;
  for (std::string word; in >> word;) words += (words.empty() ? "" : " ") + word;
  return words;
}

TEST(LastingContact, AnswersListIt) {
  const json answer = runJson({"simulate", everyPath()});
  EXPECT_EQ(answer["status"], "complete") << answer["message"];
  struct Stretch {
    const char *body, *kind;
    double from, to;
  };
  const double settles = std::sqrt(2 * 0.5 / 9.81) * 1.4 / 0.6, slip = 2 * 0.8 / (7 * 0.3 * 9.81);
  const double stops = 1 / (0.3 * 9.81);
  const Stretch expected[] = {{"bowl", "slide", 0, slip}, {"block", "slide", 0, stops}, {"still", "rest", 0, 2},
                              {"bowl", "roll", slip, 2},  {"block", "rest", stops, 2},  {"drop", "rest", settles, 2}};
  ASSERT_EQ(answer["contacts"].size(), std::size(expected)) << answer["contacts"];
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    const json& c = answer["contacts"][i];
    const Stretch& e = expected[i];
    EXPECT_EQ(c["bodies"], (json{e.body, "floor"}));
    EXPECT_EQ(c["kind"], e.kind);
    const bool ball = e.body == std::string("bowl") || e.body == std::string("drop");
    EXPECT_EQ(c["features"].size(), ball ? 1u : 4u) << c;
    EXPECT_TRUE(std::abs(c["from"].get<double>() - e.from) <= 2e-6) << c;
    EXPECT_TRUE(std::abs(c["to"].get<double>() - e.to) <= 2e-6) << c;
  }
}

TEST(LastingContact, EventsSayWhatTheyAre) {
  const json answer = runJson({"simulate", everyPath()});
  std::size_t counted = 0, low = 0;
  for (const json& event : answer["events"]) {
    const std::string kind = event["kind"];
    counted += event["counts"].get<bool>() ? 1 : 0;
    low += kind == "impact" && !event["counts"].get<bool>() ? 1 : 0;
    EXPECT_EQ(event.contains("cause"), kind == "transition") << event;
    EXPECT_EQ(event.contains("mode"), kind != "transition") << event;
    EXPECT_EQ(event.contains("settles_at"), kind == "capture") << event;
    EXPECT_EQ(event.value("cause", "slip_ends"), "slip_ends") << event;
    if (kind == "capture") {
      const double settles = std::sqrt(2 * 0.5 / 9.81) * 1.4 / 0.6;
      EXPECT_TRUE(std::abs(event["settles_at"].get<double>() - settles) <= 1e-12 * settles) << event;
    }
    EXPECT_EQ(kind == "placed", event["time"] == 0) << event;
  }
  EXPECT_GT(low, 3u);
  EXPECT_GT(counted, 3u);
  const CommandRun run = runCommand({"simulate", everyPath()});
  EXPECT_EQ(run.out.substr(0, run.out.find('\n')), std::to_string(counted) + " impacts in 2 s");
}

TEST(LastingContact, PeopleAreNotToldOfDust) {
  const CommandRun run = runCommand({"simulate", everyPath()});
  EXPECT_EQ(run.code, 0) << run.err;
  const json events = runJson({"simulate", everyPath()})["events"];
  const auto told = std::ranges::count_if(events, [](const json& e) { return e["counts"] || e["kind"] != "impact"; });
  std::size_t rows = 0;
  for (const std::string& line : linesWith(run.out, "-floor")) rows += line.starts_with("  ") ? 1 : 0;
  EXPECT_EQ(rows, static_cast<std::size_t>(told)) << run.out;
  EXPECT_LT(rows, events.size() - 3);
  for (const char* words : {"drop comes to rest", "bowl rolls", "block comes to rest", "bowl slides", "still rests"})
    EXPECT_EQ(linesWith(run.out, words).size(), 1u) << words << '\n' << run.out;
}

TEST(LastingContact, PeopleAreToldHowLong) {
  const CommandRun run = runCommand({"simulate", everyPath(), "--digits", "3"});
  const std::string below = run.out.substr(run.out.find("Persistent contacts:"));
  std::vector<std::string> rows;
  for (const std::string& line : linesWith(below, " floor ")) rows.push_back(wordsOf(line));
  EXPECT_EQ(rows, (std::vector<std::string>{"bowl slides floor 0 0.0777", "block slides floor 0 0.34",
                                            "still rests floor 0 the end", "bowl rolls floor 0.0777 the end",
                                            "block rests floor 0.34 the end", "drop rests floor 0.745 the end"}));
}

/// Two boxes that lean so far over a lower edge that they fall on their sides: one on rough ground, one on smooth.
std::string fallingBoxes() {
  const double lean = 0.4;
  const auto box = [&](const char* name, double y) {
    json body = bodyOf(name, {{"box", {{"size", {0.1, 0.1, 0.3}}}}},
                       {0, y, 0.15 * std::cos(lean) + 0.05 * std::sin(lean)}, {0, 0, 0});
    body["orientation"] = {std::cos(lean / 2), 0, std::sin(lean / 2), 0};
    return body;
  };
  json smooth = box("smooth", 1);
  smooth["material"] = "ice";
  const json combine = {{"friction", "minimum"}};
  const json scene = {{"carom", 1},
                      {"gravity", {0, 0, -9.81}},
                      {"duration", 2},
                      {"materials",
                       {{"m", {{"elasticity", 0}, {"friction", 1}, {"combine", combine}}},
                        {"ice", {{"elasticity", 0}, {"friction", 0}, {"combine", combine}}}}},
                      {"bodies",
                       {box("rough", 0),
                        smooth,
                        {{"name", "floor"},
                         {"fixed", true},
                         {"material", "m"},
                         {"shape", {{"plane", {{"normal", {0, 0, 1}}}}}}}}}};
  return writeTemporary("falling-boxes.json", scene.dump());
}

TEST(LastingContact, WhatTurnsAboutAnEdgePivots) {
  const json answer = runJson({"simulate", fallingBoxes()});
  EXPECT_EQ(answer["status"], "complete") << answer["message"];
  std::vector<std::string> kinds, causes;
  for (const json& c : answer["contacts"])
    kinds.push_back(c["bodies"][0].get<std::string>() + " " + c["kind"].get<std::string>());
  for (const json& e : answer["events"])
    if (e["kind"] == "transition") causes.push_back(e["cause"]);
  EXPECT_EQ(kinds, (std::vector<std::string>{"rough pivot", "smooth slide", "smooth rest", "rough slide", "rough rest"}));
  EXPECT_EQ(causes, std::vector<std::string>{"slips"});
  const CommandRun run = runCommand({"simulate", fallingBoxes()});
  std::vector<std::string> rows;
  for (const std::string& line : linesWith(run.out.substr(run.out.find("Persistent contacts:")), " floor "))
    rows.push_back(wordsOf(line));
  ASSERT_EQ(rows.size(), kinds.size()) << run.out;
  EXPECT_TRUE(rows[0].starts_with("rough pivots floor 0 ")) << run.out;
  EXPECT_TRUE(rows[1].starts_with("smooth slides floor 0 ")) << run.out;
  for (const char* words : {"rough pivots", "rough slides", "rough comes to rest", "smooth slides"})
    EXPECT_GE(linesWith(run.out, words).size(), 1u) << words << '\n' << run.out;
}

TEST(LastingContact, WithoutAnyNothingIsSaidOfIt) {
  const CommandRun run = runCommand({"simulate", scenePath("two-balls")});
  EXPECT_EQ(run.out.find("lasts"), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find(" then"), std::string::npos) << run.out;
  EXPECT_EQ(runJson({"simulate", scenePath("two-balls")})["contacts"], json::array());
}

TEST(LastingContact, InfoSaysWhatABodyCanDo) {
  const json answer = runJson({"info", everyPath()});
  const auto kinds = [&](int body) { return answer["bodies"][static_cast<std::size_t>(body)]["lasting_contact"]; };
  for (int body : {0, 2}) EXPECT_EQ(kinds(body), (json{"rest", "slide", "roll", "pivot"}));
  EXPECT_FALSE(answer["bodies"][4].contains("lasting_contact"));
  EXPECT_EQ(answer["bodies"][2]["lasting_contact_ends"], "moves with more than 7 others at once, or at more than 36 contacts");
  const CommandRun run = runCommand({"info", everyPath()});
  EXPECT_NE(run.out.find("  drop, bowl, block, still\n    rest, slide, roll, pivot; the motion ends where it moves "),
            std::string::npos)
      << run.out;
}

// Two stacks, one of which cannot stand: the other rests.
TEST(LastingContact, InfoNamesWhatLiesOnEachOther) {
  const auto box = [](const char* name, double x, double z) {
    return json{{"name", name}, {"mass", 1}, {"shape", {{"box", {{"size", {1, 1, 1}}}}}}, {"position", {x, 0, z}}};
  };
  json scene = {{"carom", 1}, {"duration", 1}, {"bodies", {box("low", 0, 0.5), box("high", 0.2, 1.5)}}};
  scene["bodies"].push_back({{"name", "floor"}, {"fixed", true}, {"shape", {{"plane", {{"normal", {0, 0, 1}}, {"offset", 0}}}}}});
  for (const bool stands : {true, false}) {
    scene["bodies"][1]["position"][0] = stands ? 0.2 : 0.7;
    const std::string path = writeTemporary("stack.json", scene.dump());
    const json components = runJson({"info", path})["components"];
    ASSERT_EQ(components.size(), 1u) << components;
    EXPECT_EQ(components[0]["bodies"], (json{"low", "high"}));
    EXPECT_EQ(components[0]["rests"], stands);
    const CommandRun run = runCommand({"info", path});
    EXPECT_NE(run.out.find(stands ? "  low, high\n    rest: forces within the cones of friction at 8 contacts hold all of them\n"
                                  : "  low, high\n    move on each other: no forces within the cones of friction hold all of them\n"),
              std::string::npos)
        << run.out;
  }
}

}  // namespace
}  // namespace carom::test
