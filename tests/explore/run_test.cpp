// SPDX-License-Identifier: MIT
// A run: progress, stops, and the store from which it goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "adjoint/base/errors.h"
#include "explore/explore.h"
#include "explore/store/question.h"
#include "explore/store/table_bytes.h"
#include "explore/store/table_csv.h"
#include "tests/explore/throws.h"

namespace carom {
namespace {

namespace fs = std::filesystem;
using namespace explore_test;

class Run : public ::testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string question() const {
    return questionOf({.scene = t.scene, .duration = t.duration, .controls = t.controls, .constraints = t.constraints},
                      options);
  }

  Throw t = bouncingBall();
  ExploreOptions options{.gradients = true};
  std::string folder =
      ::testing::TempDir() + "carom_store_" + ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

std::string bytesOf(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Run, TellsHowFarItIsAndStops) {
  const Exploration exploration = exploring(t, options);
  std::vector<std::uint64_t> done;
  explore(exploration, 1000, {.threads = 2, .chunk = 100, .progress = [&](const ExploreProgress& p) {
                                done.push_back(p.done + 1000 * (p.worlds != 1000));
                              }});
  EXPECT_EQ(done, (std::vector<std::uint64_t>{100, 200, 300, 400, 500, 600, 700, 800, 900, 1000}));
  std::stop_source stop;
  const WorldTable part = explore(exploration, 1000,
                                  {.threads = 2,
                                   .chunk = 100,
                                   .progress =
                                       [&](const ExploreProgress& p) {
                                         if (p.done >= 300) stop.request_stop();
                                       },
                                   .stop = stop.get_token()});
  EXPECT_TRUE(part.size() >= 300 && part.size() < 1000 && part.size() % 100 == 0) << part.size();
  const WorldTable all = explore(exploration, 1000);
  for (std::size_t k = 0; k < part.size(); ++k) EXPECT_EQ(part.end[k], all.end[part.world[k]]);
}

TEST_F(Run, GoesOnFromAStore) {
  const Exploration exploration = exploring(t, options);
  const WorldTable all = explore(exploration, 1050);
  WorldStore store(folder, question());
  std::stop_source stop;
  explore(exploration, 1050,
          {.threads = 1,
           .chunk = 100,
           .progress =
               [&](const ExploreProgress& p) {
                 if (p.done >= 400) stop.request_stop();
               },
           .stop = stop.get_token(),
           .store = &store});
  const auto files = [&] { return std::distance(fs::directory_iterator(store.folder()), fs::directory_iterator()); };
  EXPECT_EQ(files(), 4 + 1);
  const auto before = fs::last_write_time(store.folder() + "/worlds-0-100");
  // One is cut short, one has a byte that is another one, one is of other worlds, and one was being written.
  fs::resize_file(store.folder() + "/worlds-100-100", fs::file_size(store.folder() + "/worlds-100-100") / 2);
  std::string damaged = bytesOf(store.folder() + "/worlds-200-100");
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(store.folder() + "/worlds-200-100", std::ios::binary) << damaged;
  fs::copy_file(store.folder() + "/worlds-0-100", store.folder() + "/worlds-400-100");
  std::ofstream(store.folder() + "/worlds-500-100.part") << "CAROMWT1";
  WorldStore again(folder, question());
  EXPECT_TRUE(explore(exploration, 1050, {.threads = 2, .chunk = 100, .store = &again}) == all);
  EXPECT_EQ(fs::last_write_time(store.folder() + "/worlds-0-100"), before);  // not done again
  // Complete, it is read alone: a file of other values shows it.
  WorldTable marked = *tableOfBytes(bytesOf(store.folder() + "/worlds-0-100"));
  marked.end[7] = 42;
  again.write(0, marked);
  EXPECT_EQ(explore(exploration, 1050, {.chunk = 100, .store = &again}).end[7], 42);
}

TEST_F(Run, AStoreOfAnotherQuestionIsNotTaken) {
  const std::string first = question();
  const WorldStore store(folder, first);
  std::vector<std::string> folders = {store.folder()};
  options.seed = 1;
  folders.push_back(WorldStore(folder, question()).folder());
  options.points = Points::sobol;
  folders.push_back(WorldStore(folder, question()).folder());
  options.gradients = false;
  folders.push_back(WorldStore(folder, question()).folder());
  t.scene.bodies[1].velocity.x() = std::nextafter(t.scene.bodies[1].velocity.x(), 9);
  folders.push_back(WorldStore(folder, question()).folder());
  t.controls[0].distribution = NormalDistribution{{}, {0.3, 0.2, 0.41}};
  folders.push_back(WorldStore(folder, question()).folder());
  std::ranges::sort(folders);
  EXPECT_EQ(std::unique(folders.begin(), folders.end()), folders.end());
  t.scene.bodies[1].notes = "for readers", t.controls[0].notes = "alike";
  EXPECT_TRUE(std::ranges::find(folders, WorldStore(folder, question()).folder()) != folders.end());
  std::ofstream(store.folder() + "/question") << "another one";  // of the same hash
  EXPECT_THROW(WorldStore(folder, first), InputError);
  std::ofstream(folder + "_file") << "no folder";
  EXPECT_THROW(WorldStore(folder + "_file", first), InputError);
  fs::remove(folder + "_file");
}

TEST_F(Run, BytesReadBackAndDamageIsSeen) {
  const Exploration exploration = exploring(t, options);
  const WorldTable table = exploration.chunk(5, 9);
  const std::string bytes = tableBytes(table);
  ASSERT_TRUE(tableOfBytes(bytes));
  EXPECT_TRUE(*tableOfBytes(bytes) == table);
  EXPECT_TRUE(tableOfBytes(tableBytes(exploration.chunk(0, 0)))->size() == 0);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string damaged = bytes;
    damaged[k] ^= 16;
    EXPECT_FALSE(tableOfBytes(damaged)) << k;
    EXPECT_FALSE(tableOfBytes(bytes.substr(0, k))) << k;
  }
}

TEST_F(Run, TextHasALineAWorld) {
  const Exploration exploration = exploring(t, options);
  const std::string csv = tableCsv(exploration, exploration.chunk(0, 3));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  const std::string headings = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(headings.substr(0, 80),
            "world,status,flags,impacts,end,signature,\"velocity.x of 'ball'\",\"velocity.y of '");
  EXPECT_NE(headings.find("\"d position.x of 'ball' at 1.2 s / d elasticity of 'm'\""), std::string::npos);
  EXPECT_EQ(csv.substr(csv.find('\n') + 1, 11), "0,complete,");
}

}  // namespace
}  // namespace carom
