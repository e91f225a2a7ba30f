// carom replay: exit codes, the answer, and what it says when a journal does not come to what it says.
#include <gtest/gtest.h>

#include "editing/session.h"
#include "formats/journal_json.h"
#include "formats/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "tests/cli/run_command.h"

namespace carom::test {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

SessionJournal shortSession() {
  Scene scene;
  scene.materials.push_back({.name = "court", .elasticity = 0.7, .friction = 0.4});
  Body floor, ball;
  floor.name = "floor", floor.fixed = true, floor.material = "court", floor.shape = Plane{};
  ball.name = "ball", ball.material = "court", ball.shape = Sphere{0.033}, ball.mass = 0.057;
  ball.position = {0, 0, 1}, ball.velocity = {3, 0, 2};
  scene.bodies = {floor, ball};
  OdeContacts contacts(scene);
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  EditSession session(scene, contacts, 2, options);
  session.vary(velocity("ball"), elasticity("court"));
  session.grab("ball", 1.5);
  session.dragTo(session.grabbedPlace() + Vec3(0.2, 0.1, 0.05));
  session.release();
  return session.journal();
}

TEST(Replay, PlaysAndWritesTheScene) {
  const std::string path = temporaryPath("journal.json"), out = temporaryPath("edited.json");
  saveJournal(path, {shortSession(), ""});
  const json answer = runJson({"replay", path, "-o", out});
  EXPECT_EQ(membersOf(answer), (Names{"file", "gestures", "numbers", "output", "same"}));
  EXPECT_EQ(answer["same"], true);
  EXPECT_EQ(answer["output"], out);
  ASSERT_EQ(answer["gestures"].size(), 2u);
  EXPECT_EQ(answer["gestures"][0]["gesture"], "controls");
  EXPECT_EQ(answer["gestures"][1]["gesture"], "drag");
  EXPECT_EQ(answer["gestures"][1]["reached"], true);
  const Document edited = readDocument(out);
  EXPECT_EQ(answer["numbers"][0]["value"].get<double>(), edited.scene.bodies[1].velocity.x());
  const CommandRun text = runCommand({"replay", path});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("drag 'ball'"), std::string::npos) << text.out;
}

TEST(Replay, SaysWhereItDiffers) {
  SessionJournal journal = shortSession();
  journal.gestures[1].numbers[0] += 0.5;
  const std::string path = temporaryPath("differs.json");
  saveJournal(path, {journal, ""});
  const json answer = runJson({"replay", path}, 4);
  EXPECT_EQ(answer["same"], false);
  const CommandRun run = runCommand({"replay", path});
  EXPECT_EQ(run.code, 4);
  EXPECT_NE(run.err.find("/gestures/1: velocity of 'ball', x: found"), std::string::npos) << run.err;
}

TEST(Replay, BadJournals) {
  EXPECT_EQ(runCommand({"replay", temporaryPath("none.json")}).code, 1);
  EXPECT_EQ(runCommand({"replay"}).code, 2);
  const std::string scene = scenePath(sceneNames().front());
  const CommandRun run = runCommand({"replay", scene});
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("no member \"carom_journal\""), std::string::npos) << run.err;
}

}  // namespace
}  // namespace carom::test
