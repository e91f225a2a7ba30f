// SPDX-License-Identifier: MIT
// What was shown as done is there after the server is gone, whenever that was; and nothing ends by what the disk does.
#include "studio/autosave.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <random>

#include "formats/documents/scene_json.h"
#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

/// A worker that was started on a folder where another one worked before.
struct Started {
  Mailbox mailbox;
  Received received;
  Workspace workspace;
  std::unique_ptr<Worker> worker;
  std::int64_t id = 0;

  explicit Started(const TestFolder& folder) : workspace(folder.path()) {
    WorkerOptions options;
    options.session = "s2";
    options.solving = solvingWithoutClock();
    worker = std::make_unique<Worker>(
        mailbox, workspace, Post{[this](SocketId to, const Outgoing& message) { received.add(to, message); }}, options);
    worker->openFirst("bounce.json");
    ask({{"type", "hello"}, {"protocol", 1}, {"token", ""}, {"tab", "tab"}}, false);
  }
  std::vector<Json> ask(Json message, bool forget = true) {
    if (forget) received.take(1);
    message["id"] = ++id;
    mailbox.put({1, readCommand(message.dump())});
    worker->step({});
    last = received.take(1);
    return last;
  }
  Json state() const { return lastOf(last, "state"); }
  std::vector<Json> last;
};

/// One gesture of many kinds; what the state says of it then.
Json gesture(Started& studio, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across(0.3, 0.6), up(1, 1.3);
  const std::int64_t number = studio.id + 1;
  switch (random() % 7) {
    case 0:
      studio.ask({{"type", "undo"}});
      break;
    case 1:
      studio.ask({{"type", "redo"}});
      break;
    case 2:
      studio.ask({{"type", "nail"}, {"body", "other"}, {"at", 0.2}});
      break;
    case 3:
      studio.ask({{"type", "set"},
                  {"rev", studio.state()["rev"]},
                  {"edits", {{{"pointer", "/bodies/1/velocity/0"}, {"value", across(random)}}}}});
      break;
    default: {
      Json grab = kGrab, drag = dragTo(1, across(random), up(random));
      grab["gesture"] = drag["gesture"] = number;
      studio.ask(grab), studio.ask(drag);
      if (random() % 4 == 0)
        studio.ask({{"type", "cancel"}, {"gesture", number}});
      else
        studio.ask({{"type", "release"}, {"gesture", number}, {"seq", 1}});
    }
  }
  return studio.state();
}

/// What a person would miss.
Json essence(const Json& state) {
  return {state["numbers"], state["nails"], state["undo"], state["redo"], state["controls"], state["saved"]};
}

TEST(Autosave, EveryStepThatWasShownIsThereAfterAnEndAtAnyMoment) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    TestFolder folder;
    folder.write("bounce.json", kTestScene);
    std::mt19937_64 random(seed);
    std::vector<std::pair<std::string, Json>> shown;  // the steps on the disk, and the state that was shown then
    {
      Started studio(folder);
      for (int k = 0; k < 12; ++k) {
        const Json state = gesture(studio, random);
        shown.emplace_back(folder.read(".bounce.json.steps"), essence(state));
      }
    }
    for (std::size_t k = 0; k < shown.size(); ++k) {
      // killed while the next line was being written
      const std::string next = k + 1 < shown.size() ? shown[k + 1].first : shown[k].first;
      const std::size_t whole = shown[k].first.size(), more = next.size() > whole ? random() % (next.size() - whole) : 0;
      folder.write(".bounce.json.steps", shown[k].first + (more > 0 ? next.substr(whole, more) : ""));
      Started again(folder);
      EXPECT_EQ(essence(again.state()), shown[k].second) << k;
      EXPECT_EQ(lastOf(again.last, "notice"), nullptr);
    }
    folder.write(".bounce.json.steps", shown.back().first);
    Started again(folder);
    const std::size_t recovered = again.state()["recovered"];
    EXPECT_EQ(lastOf(again.last, "welcome")["recovered"], recovered);
    for (std::size_t k = 0; k < recovered; ++k) again.ask({{"type", "undo"}});
    EXPECT_TRUE(again.state()["undo"].is_null());
    again.ask({{"type", "save"}});
    EXPECT_EQ(folder.read("bounce.json"), kTestScene) << "undo goes to the bytes that were opened";
  }
}

TEST(Autosave, NoFileIsLeftWhereNothingIsUnsaved) {
  TestFolder folder;
  folder.write("bounce.json", kTestScene);
  const auto there = [&](const char* name) { return std::filesystem::exists(folder / name); };
  { Started studio(folder); }
  EXPECT_FALSE(there(".bounce.json.steps"));
  std::mt19937_64 random(4);
  {
    Started studio(folder);
    while (studio.state().is_null() || studio.state()["undo"].is_null()) gesture(studio, random);
    EXPECT_TRUE(there(".bounce.json.steps"));
    studio.ask({{"type", "save"}, {"path", "other.json"}});
    EXPECT_TRUE(there(".other.json.steps") && !there(".bounce.json.steps")) << "they go with the name";
  }
  EXPECT_FALSE(there(".other.json.steps")) << "all was saved";
}

TEST(Autosave, StepsOnAnotherTextAreKeptAside) {
  TestFolder folder;
  folder.write("bounce.json", kTestScene);
  std::mt19937_64 random(5);
  {
    Started studio(folder);
    while (studio.state().is_null() || studio.state()["undo"].is_null()) gesture(studio, random);
  }
  const std::string steps = folder.read(".bounce.json.steps");
  folder.write("bounce.json", std::string(kTestScene) + "\n");
  Started again(folder);
  EXPECT_EQ(again.state()["recovered"], 0);
  EXPECT_NE(lastOf(again.last, "notice")["message"].get<std::string>().find(".bounce.json.steps.1"), std::string::npos);
  EXPECT_EQ(folder.read(".bounce.json.steps.1"), steps);
  TestFolder broken;
  broken.write("bounce.json", kTestScene);
  broken.write(".bounce.json.steps", "{\"carom_steps\":1}\nnonsense\n");
  Started opened(broken);
  EXPECT_EQ(opened.state()["recovered"], 0);
  EXPECT_NE(lastOf(opened.last, "notice")["message"].get<std::string>().find("cannot be read"), std::string::npos);
}

TEST(Autosave, OneProgramKeepsTheStepsOfAScene) {
  TestFolder folder;
  folder.write("bounce.json", kTestScene);
  std::mt19937_64 random(6);
  Started first(folder);
  while (first.state().is_null() || first.state()["undo"].is_null()) gesture(first, random);
  const std::string steps = folder.read(".bounce.json.steps");
  Started second(folder);
  EXPECT_NE(lastOf(second.last, "notice")["message"].get<std::string>().find("another carom studio"), std::string::npos);
  while (second.state().is_null() || second.state()["undo"].is_null()) gesture(second, random);
  EXPECT_EQ(folder.read(".bounce.json.steps"), steps) << "and the other goes on without";
}

TEST(Autosave, AFullDiskIsSaidOnceAndStepsAreWrittenOnceThereIsRoom) {
  TestFolder folder;
  folder.write("bounce.json", kTestScene);
  Started studio(folder);
  const auto drag = [&](std::int64_t number, double x) {
    Json grab = kGrab;
    grab["gesture"] = number;
    studio.ask(grab);
    return studio.ask({{"type", "release"}, {"gesture", number}, {"seq", 1}, {"place", {x, 0, 1.1}}});
  };
  drag(1, 0.5);
  const std::size_t room = folder.read(".bounce.json.steps").size() + 100;
  const auto before = ::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  rlimit little = limit;
  little.rlim_cur = room;
  ::setrlimit(RLIMIT_FSIZE, &little);
  const std::vector<Json> told = drag(2, 0.52), silent = drag(3, 0.54);
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, before);
  EXPECT_NE(lastOf(told, "notice")["message"].get<std::string>().find("Steps are not kept"), std::string::npos);
  EXPECT_EQ(lastOf(silent, "notice"), nullptr) << "once";
  EXPECT_FALSE(lastOf(silent, "state")["undo"].is_null()) << "and it goes on";
  EXPECT_LE(folder.read(".bounce.json.steps").size(), room);
  const Json state = lastOf(drag(4, 0.56), "state");
  const std::string steps = folder.read(".bounce.json.steps");
  TestFolder other;
  other.write("bounce.json", kTestScene);
  other.write(".bounce.json.steps", steps);
  Started again(other);
  EXPECT_EQ(essence(again.state()), essence(state));
  EXPECT_EQ(again.state()["recovered"], 4);
}

}  // namespace
}  // namespace carom::studio
