// SPDX-License-Identifier: MIT
// The page's own modules, run in node, against the motion: frames decoded by frames.js, poses of motion.js. Where node
// is missing these tests are skipped, but not with CAROM_REQUIRE_THREE set.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adjoint/simulate/simulate.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "studio/frames.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"

namespace carom::studio_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMove = 1e-9, kTurn = 2e-3;  // m, rad
constexpr int kTimes = 200;
const std::string kPage = projectFile("studio/page");

bool runs(const std::string& command) { return std::system(command.c_str()) == 0; }

class PageMotion : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kPage + "/motion.js")) GTEST_SKIP() << "studio/page is missing";
    if (!runs("node --version >/dev/null 2>&1")) {
      if (std::getenv("CAROM_REQUIRE_THREE") != nullptr) FAIL() << "node is missing: scripts/setup three";
      GTEST_SKIP() << "node is missing: scripts/setup three";
    }
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  void add(const std::string& name, Motion motion) {
    test::Random random(6);
    std::vector<double> times = {0, motion.end};
    for (int i = 0; i < kTimes; ++i) times.push_back(random.in(0, motion.end));
    std::ofstream(folder_ / (name + ".times")) << json(times).dump();
    std::ofstream(folder_ / (name + ".frame"), std::ios::binary)
        << studio::motionFrame(studio::viewOf(motion), R"({"rev": 1})");
    shown_.push_back({name, std::move(motion), std::move(times)});
  }

  void expectPage() const {
    const std::string script = projectFile("tests/studio/page_motion.mjs");
    ASSERT_TRUE(runs("node '" + script + "' '" + kPage + "' '" + folder_.string() + "'"));
    for (const Shown& shown : shown_) expectPoses(shown);
  }

 private:
  struct Shown {
    std::string name;
    Motion motion;
    std::vector<double> times;
  };

  void expectPoses(const Shown& shown) const {
    SCOPED_TRACE(shown.name);
    std::ifstream in(folder_ / (shown.name + ".poses"));
    ASSERT_TRUE(in);
    const json poses = json::parse(in);
    ASSERT_EQ(poses.size(), shown.motion.scene->bodies.size());
    for (std::size_t body = 0; body < poses.size(); ++body) {
      ASSERT_EQ(poses[body].size(), shown.times.size());
      for (std::size_t k = 0; k < shown.times.size(); ++k) {
        const auto page = poses[body][k].get<std::array<double, 10>>();
        expectPose(shown.motion, static_cast<int>(body), shown.times[k], page);
        if (testing::Test::HasFailure()) return;  // one is enough
      }
    }
  }

  static void expectPose(const Motion& motion, int body, double t, const std::array<double, 10>& page) {
    const BodyState state = motion.stateAt(body, t);
    const Vec3& offset = (*motion.models)[static_cast<std::size_t>(body)].center;
    const Vec3 center = state.position + state.orientation * offset;
    const double move = (Vec3(page[0], page[1], page[2]) - center).norm();
    const Quat q(page[3], page[4], page[5], page[6]);
    const double turn = q.angularDistance(state.orientation);
    const double origin = (Vec3(page[7], page[8], page[9]) - state.position).norm();
    test::recordShare(std::max(move / kMove, turn / kTurn));
    const std::string at = motion.scene->bodies[static_cast<std::size_t>(body)].name + " at " + std::to_string(t);
    EXPECT_TRUE(move <= kMove) << at << " s: " << move << " m off";
    EXPECT_TRUE(turn <= kTurn) << at << " s: " << turn << " rad off";
    EXPECT_TRUE(origin <= kMove + kTurn * offset.norm()) << at << " s: " << origin << " m off";
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("carom-page-motion-" + std::to_string(getpid()));
  std::vector<Shown> shown_;
};

TEST_F(PageMotion, IsTheMotionOfEveryExample) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(projectFile("examples/scenes"))) {
    if (entry.path().extension() != ".json") continue;
    const Document document = readDocument(entry.path().string());
    OdeContacts contacts(document.scene);
    add(entry.path().stem().string(), simulate(document.scene, contacts, document.duration));
    ++scenes;
  }
  EXPECT_GE(scenes, 20);
  expectPage();
}

TEST_F(PageMotion, IsTheMotionOfWhatLasts) {
  for (const test::DotProductScene& row : test::lastingScenes()) add(row.name, test::motionOf(row));
  expectPage();
}

}  // namespace
}  // namespace carom::studio_test
