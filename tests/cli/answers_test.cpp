// SPDX-License-Identifier: MIT
// Every command on every example scene: exit codes, and the members and numbers of the JSON answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "adjoint/simulate/simulate.h"
#include "editing/problem/jacobian.hpp"
#include "editing/problem/rows/refined_times.hpp"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"

namespace carom::test {

using namespace editing_detail;

namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

class OnScene : public testing::TestWithParam<std::string> {
 protected:
  std::string path() const { return scenePath(GetParam()); }
};

std::string nameOfScene(const testing::TestParamInfo<std::string>& test) {
  std::string name = test.param;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Examples, OnScene, testing::ValuesIn(sceneNames()), nameOfScene);

/// All but those that take seconds: they are edited once, where the answer is checked number by number.
Names scenesQuickToEdit() {
  Names names = sceneNames();
  for (const char* slow : {"pen_500", "die-at-rest", "bowling", "rack-of-ten", "rack-of-fifteen", "boxes-edge-to-edge"})
    std::erase(names, slow);
  return names;
}

void expectTextForPeople(const std::string& command, const std::string& path) {
  const CommandRun run = runCommand({command, path});
  EXPECT_EQ(run.code, 0) << command << run.err;
  EXPECT_GT(run.out.size(), 40u) << command;
  EXPECT_NE(run.out.front(), '{') << command;
  EXPECT_EQ(run.err, "") << command;  // progress only on a terminal
}

void expectVector(const json& found, const Vec3& expected) {
  ASSERT_EQ(found.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(found[static_cast<std::size_t>(i)].get<double>(), expected[i]);
}

/// How far a row of an answer is from its target or outside its range.
double missOf(const json& row) {
  const auto value = row["value"].get<double>();
  if (!row["target"].is_null()) return std::abs(value - row["target"].get<double>());
  double miss = 0;
  if (!row["min"].is_null()) miss = std::max(miss, row["min"].get<double>() - value);
  if (!row["max"].is_null()) miss = std::max(miss, value - row["max"].get<double>());
  return miss;
}

TEST(Examples, AreAtLeastSix) { EXPECT_GE(sceneNames().size(), 6u); }

TEST_P(OnScene, SimulateGivesTheMotionToTheLastBit) {
  const Document document = readDocument(path());
  OdeContacts contacts(document.scene);
  const Motion motion = simulate(document.scene, contacts, document.duration);
  const json answer = runJson({"simulate", path(), "--at", "0.125", "--at", "0.55"});
  EXPECT_EQ(membersOf(answer), (Names{"contacts", "end", "events", "message", "overlaps", "states", "status"}));
  EXPECT_EQ(answer["status"], nameOf(motion.status));
  ASSERT_EQ(answer["events"].size(), motion.events.size());
  for (std::size_t i = 0; i < motion.events.size(); ++i) {
    const json& event = answer["events"][i];
    EXPECT_EQ(event["time"].get<double>(), motion.events[i].time);
    EXPECT_EQ(event["kind"], nameOf(motion.events[i].kind));
    EXPECT_EQ(event["counts"], motion.events[i].counts());
    if (event["kind"] == "transition") continue;
    EXPECT_EQ(event["mode"], nameOf(motion.events[i].mode));
    expectVector(event["point"], motion.events[i].contacts[0].at.point);
    expectVector(event["normal"], motion.events[i].contacts[0].at.normal);
    for (const char* member : {"bodies", "elasticity", "margin"}) EXPECT_TRUE(event.contains(member)) << member;
  }
  ASSERT_EQ(answer["states"].size(), 2u);
  for (const json& at : answer["states"]) {
    EXPECT_EQ(membersOf(at), (Names{"bodies", "time"}));
    ASSERT_EQ(at["bodies"].size(), document.scene.bodies.size());
    for (const Body& body : document.scene.bodies) {
      const BodyState state = motion.stateAt(body.name, at["time"].get<double>());
      const json& found = at["bodies"][body.name];
      EXPECT_EQ(membersOf(found), (Names{"angular_velocity", "orientation", "position", "velocity"}));
      expectVector(found["position"], state.position);
      expectVector(found["velocity"], state.velocity);
      expectVector(found["angular_velocity"], state.angular_velocity);
      EXPECT_EQ(found["orientation"][0].get<double>(), state.orientation.w());
    }
  }
}

TEST_P(OnScene, SimulateWithoutTimesGivesTheEnd) {
  const json answer = runJson({"simulate", path()});
  ASSERT_EQ(answer["states"].size(), 1u);
  EXPECT_EQ(answer["states"][0]["time"], answer["end"]);
  EXPECT_EQ(answer["end"].get<double>(), readDocument(path()).duration);
}

TEST_P(OnScene, GradientByAdjointIsThatOfTheLibraryAndThatByTangent) {
  Document document = readDocument(path());
  for (Constraint& constraint : document.constraints) constraint.soft.reset();
  OdeContacts contacts(document.scene);
  const EditProblem problem(document.scene, contacts, document.duration, document.controls, document.constraints);
  const Eigen::VectorXd values = problem.controls.startValues();
  RowsAndJacobian expected;
  expected.motion = simulateAt(problem, values, problem.horizon);
  const Eigen::VectorXd times = refinedTimes(problem.constraints, expected.motion);
  expected.rows = problem.constraints.evaluate(expected.motion, times);
  expected.jacobian = jacobianByAdjoint(problem, values, expected.motion, expected.rows);

  const json by_adjoint = runJson({"gradient", path()});
  const json by_tangent = runJson({"gradient", path(), "--method", "tangent"});
  EXPECT_EQ(membersOf(by_adjoint), (Names{"columns", "jacobian", "message", "reliable", "rows", "signature", "times"}));
  const std::string message = by_adjoint["message"].get<std::string>();
  const bool explained = message.find("joins several contacts") != std::string::npos || message.find("at a seam between flush") != std::string::npos;
  EXPECT_TRUE(by_adjoint["reliable"].get<bool>() || explained) << message;
  EXPECT_EQ(by_adjoint["rows"], by_tangent["rows"]);
  EXPECT_EQ(by_adjoint["columns"], by_tangent["columns"]);
  EXPECT_EQ(by_adjoint["signature"], by_tangent["signature"]);
  ASSERT_EQ(by_adjoint["rows"].size(), static_cast<std::size_t>(problem.constraints.size()));
  ASSERT_EQ(by_adjoint["columns"].size(), static_cast<std::size_t>(problem.controls.size()));
  for (const json& row : by_adjoint["rows"]) {
    Names members{"component", "constraint", "name", "target", "value"};
    if (row["target"].is_null()) members = {"component", "constraint", "max", "min", "name", "target", "value"};
    EXPECT_EQ(membersOf(row), members);
  }
  EXPECT_EQ(membersOf(by_adjoint["columns"][0]), (Names{"component", "control", "name", "value"}));
  ASSERT_EQ(by_adjoint["jacobian"].size(), by_adjoint["rows"].size());
  // of a row that rest on a face fixes only rounding is left
  const double rounding = 0x1p-52 * std::max(1.0, expected.jacobian.cwiseAbs().maxCoeff());
  for (int i = 0; i < problem.constraints.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(by_adjoint["rows"][row]["component"], problem.constraints.rows()[row].name);
    EXPECT_EQ(by_adjoint["rows"][row]["value"].get<double>(), expected.rows.values[i]);
    ASSERT_EQ(by_adjoint["jacobian"][row].size(), by_adjoint["columns"].size());
    const double scale = std::max(expected.jacobian.row(i).cwiseAbs().maxCoeff(), rounding);
    for (int j = 0; j < problem.controls.size(); ++j) {
      const auto column = static_cast<std::size_t>(j);
      const double entry = by_adjoint["jacobian"][row][column].get<double>();
      EXPECT_EQ(entry, expected.jacobian(i, j));
      const double error = std::abs(entry - by_tangent["jacobian"][row][column].get<double>());
      EXPECT_TRUE(error <= 1e-12 * scale) << "entry " << i << ", " << j << " differs by " << error;
    }
  }
}

TEST_P(OnScene, CheckPasses) {
  const json answer = runJson({"check", path()});
  EXPECT_EQ(membersOf(answer),
            (Names{"columns", "message", "not_compared", "passed", "sequence", "worst_differences", "worst_tangent"}));
  EXPECT_TRUE(answer["passed"].get<bool>()) << answer["message"];
  EXPECT_LE(answer["worst_differences"]["disagreement"].get<double>(), 1e-6);
  EXPECT_LE(answer["worst_tangent"]["disagreement"].get<double>(), 1e-12);
}

TEST_P(OnScene, EditMeetsEveryConstraintAndWritesTheScene) {
  const std::string before = readText(path()), edited = temporaryPath(GetParam() + ".json");
  Names command{"edit", path(), "-o", edited};
  if (GetParam() == "die-at-rest") command.insert(command.end(), {"--effort", "fast"});
  const json answer = runJson(command);
  EXPECT_EQ(readText(path()), before);
  Names members{"alternatives",    "certificate",      "changed",           "growth",   "iterations",
                "message",         "met",              "milliseconds",      "objective", "output",
                "reliable",        "residual",         "residuals",         "scaled_residual",
                "sequence_after",  "sequence_before",  "sequence_changes",  "signature_changed",
                "status",          "times",            "why_not"};
  const bool fitted = answer.contains("fit");  // to soft constraints, whose errors are told and stay
  if (fitted) members.insert(members.end(), {"fit", "soft_residuals"});
  std::sort(members.begin(), members.end());
  EXPECT_EQ(membersOf(answer), members);
  EXPECT_TRUE(answer["met"].get<bool>());
  double shares = 0;
  for (const json& changed : answer["changed"]) shares += changed["share"].get<double>();
  EXPECT_TRUE(std::abs(shares - (answer["objective"] == 0 ? 0 : 1)) <= 1e-12) << shares;
  EXPECT_TRUE(answer["why_not"].is_null());
  EXPECT_TRUE(answer["certificate"]["deepest_penetration"].get<double>() <= 1e-9) << answer["certificate"];
  EXPECT_EQ(answer["output"], edited);
  for (const json& held : answer["residuals"]) {
    EXPECT_TRUE(std::abs(held["error"].get<double>()) <= 1e-8) << held;
    EXPECT_TRUE(missOf(held) <= 1e-8) << held;
  }
  // What was written is what was found: its gradient starts from the values after the edit, on the targets.
  const json gradient = runJson({"gradient", edited});
  for (const json& column : gradient["columns"]) {
    for (const json& changed : answer["changed"]) {
      if (column["control"] != changed["control"] || column["component"] != changed["component"]) continue;
      EXPECT_EQ(column["name"], changed["name"]);
      EXPECT_EQ(column["value"], changed["after"]) << changed["name"];
    }
  }
  for (std::size_t i = 0; i < gradient["rows"].size(); ++i) {
    const json& row = gradient["rows"][i];
    const double left = fitted ? std::abs(answer["soft_residuals"][i]["error"].get<double>()) : 0;
    EXPECT_TRUE(std::abs(missOf(row) - left) <= 1e-8) << row;
  }
}

class OnSceneQuickToEdit : public OnScene {};
INSTANTIATE_TEST_SUITE_P(Examples, OnSceneQuickToEdit, testing::ValuesIn(scenesQuickToEdit()), nameOfScene);

TEST_P(OnSceneQuickToEdit, EditWithoutOutputWritesNothing) {
  EXPECT_TRUE(runJson({"edit", path()})["output"].is_null());
}

TEST_P(OnSceneQuickToEdit, EditTellsPeople) { expectTextForPeople("edit", path()); }

TEST_P(OnScene, ExportWritesEveryFormat) {
  for (const char* extension : {".glb", ".gltf", ".py", ".csv", ".svg"}) {
    const std::string file = temporaryPath(GetParam() + extension);
    const json answer = runJson({"export", path(), "-o", file});
    EXPECT_EQ(membersOf(answer), (Names{"bytes", "end", "file", "message", "status"}));
    EXPECT_EQ(answer["file"], file);
    EXPECT_EQ(answer["bytes"].get<std::size_t>(), readText(file).size());
    EXPECT_GT(answer["bytes"].get<std::size_t>(), 200u);
  }
  EXPECT_EQ(readText(temporaryPath(GetParam() + ".glb")).substr(0, 4), "glTF");
}

TEST_P(OnScene, ValidateAcceptsAndInfoExplains) {
  EXPECT_EQ(membersOf(runJson({"validate", path()})),
            (Names{"bodies", "constraints", "controls", "file", "message", "repairs", "valid"}));
  const json info = runJson({"info", path()});
  EXPECT_EQ(membersOf(info), (Names{"asked", "bodies", "components", "controls", "duration", "name", "notes", "overlaps", "pairs", "repairs", "rows"}));
  EXPECT_EQ(info["bodies"].size(), readDocument(path()).scene.bodies.size());
  for (const json& body : info["bodies"]) {
    Names members{"derivative_tier", "derivative_why", "dimensions", "name", "shape", "tier", "why"};
    if (body.contains("mass"))  // moving
      members.insert(members.end(), {"center_of_mass", "lasting_contact", "lasting_contact_ends", "mass", "moments"});
    if (body.contains("kinematic")) members.insert(members.end(), {"center_of_mass", "kinematic"});
    if (body.contains("surface_velocity")) members.insert(members.end(), {"surface_angular_velocity", "surface_velocity"});
    std::sort(members.begin(), members.end());
    EXPECT_EQ(membersOf(body), members);
    EXPECT_NE(body["why"], "");
    EXPECT_NE(body["derivative_why"], "") << body["name"];
  }
  for (const json& pair : info["pairs"])
    EXPECT_EQ(membersOf(pair), (Names{"bodies", "elasticity", "friction", "law", "tangential_elasticity", "why"}));
}

TEST_P(OnScene, TextForPeopleComesWithoutJson) {
  for (const char* command : {"simulate", "gradient", "check", "validate", "info"})
    expectTextForPeople(command, path());
}

// Three digits, and nothing twice; what people wrote is shown as they wrote it.
TEST(Digits, OfAnEditArePlentyWithThree) {
  const std::vector<std::string> words{"edit", scenePath("ball-over-wall")};
  const CommandRun run = runCommand(words);
  const json answer = runJson(words);
  const auto count = [&](const std::string& text) {
    int found = 0;
    for (std::size_t at = run.out.find(text); at != std::string::npos; at = run.out.find(text, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("largest error"), 1) << run.out;
  EXPECT_EQ(count("share"), 1);
  for (const json& changed : answer["changed"]) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3g", changed["after"].get<double>() - changed["before"].get<double>());
    EXPECT_NE(run.out.find(text), std::string::npos) << text << '\n' << run.out;
  }
  const std::regex longer("[1-9][0-9]*[.][0-9]{4,}|0[.]0*[1-9][0-9]{3,}");
  EXPECT_FALSE(std::regex_search(run.out, longer)) << run.out;
  EXPECT_TRUE(std::regex_search(runCommand({words[0], words[1], "--digits", "17"}).out, longer));
}

TEST(Digits, ShowEverythingAtSeventeen) {
  const json answer = runJson({"simulate", scenePath("ball-over-wall")});
  const CommandRun run = runCommand({"simulate", scenePath("ball-over-wall"), "--digits", "17"});
  char text[64];
  std::snprintf(text, sizeof text, "%.17g", answer["events"][0]["time"].get<double>());
  EXPECT_NE(run.out.find(text), std::string::npos) << run.out;
}

}  // namespace
}  // namespace carom::test
