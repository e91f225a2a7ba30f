// SPDX-License-Identifier: MIT
// carom replay: exit codes, the answer, and what it says when a journal does not come to what it says.
#include <gtest/gtest.h>

#include "formats/documents/journal_json.h"
#include "formats/documents/scene_json.h"
#include "tests/cli/run_command.h"
#include "tests/cli/short_session.h"

namespace carom::test {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

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
  EXPECT_NE(run.err.find("/gestures/1: velocity.x of 'ball': found"), std::string::npos) << run.err;
}

TEST(Replay, PlaysWhatAStudioDid) {
  const std::string path = temporaryPath("studio.json");
  saveJournal(path, {studioSession(), ""});
  const json answer = runJson({"replay", path});
  EXPECT_EQ(answer["same"], true);
  Names gestures;
  for (const json& gesture : answer["gestures"]) gestures.push_back(gesture["gesture"]);
  EXPECT_EQ(gestures, (Names{"meet_nails", "drag", "drag", "nail_on", "content", "set_nail", "undo"}));
  EXPECT_EQ(answer["gestures"][1]["updates"], 2) << "one of them rests";
  const CommandRun text = runCommand({"replay", path});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* words : {"drag 'ball', then nailed", "drag 'ball', nail 1", "nail_on, switched off", "content: a heavier ball"})
    EXPECT_NE(text.out.find(words), std::string::npos) << words << '\n' << text.out;
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
