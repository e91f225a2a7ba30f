// SPDX-License-Identifier: MIT
// What was repaired of the mesh files of a scene is told with it.
#include <gtest/gtest.h>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

constexpr const char* kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

constexpr const char* kScene = R"({"carom": 1, "duration": 1, "bodies": [
  {"name": "crate", "density": 500, "shape": {"mesh": {"file": "crate.obj"}}, "position": [0, 0, 1]}]})";

Json stateOf(const std::string& mesh) {
  WorkerTest studio("");
  studio.folder.write("crate.obj", mesh);
  studio.folder.write("crate.json", kScene);
  studio.worker->openFirst("crate.json");
  studio.hello(1);
  studio.worker->step({});
  return lastOf(studio.received.take(1), "state");
}

TEST(Repairs, AreToldWithTheScene) {
  const Json sliver = stateOf(std::string(kCube) + "f 1 2 1\n");
  ASSERT_EQ(sliver["open"], true) << sliver;
  ASSERT_TRUE(sliver.contains("repairs")) << sliver;
  ASSERT_EQ(sliver["repairs"].size(), 1u);
  const std::string told = sliver["repairs"][0];
  EXPECT_TRUE(told.starts_with("crate.obj was repaired: ")) << told;
}

TEST(Repairs, OfSoundFilesAreNone) {
  const Json sound = stateOf(kCube);
  ASSERT_EQ(sound["open"], true) << sound;
  EXPECT_FALSE(sound.contains("repairs"));
}

}  // namespace
}  // namespace carom::studio
