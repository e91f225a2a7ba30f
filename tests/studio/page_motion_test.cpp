// SPDX-License-Identifier: MIT
// The page's own modules, run in node, against the motion: frames decoded by frames.js, poses of motion.js. Where node
// or the page is missing these tests are skipped, but not with CAROM_REQUIRE_THREE set.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "adjoint/simulate/simulate.h"
#include "formats/documents/scene_json.h"
#include "ode_bridge/ode_contacts.h"
#include "studio/frames.h"
#include "tests/support/compare.h"
#include "tests/support/lasting_scenes.h"
#include "tests/test_paths.h"

namespace carom::studio_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMove = 1e-9, kTurn = 2e-3;  // m, rad
constexpr int kTimes = 200;
const std::string kPage = CAROM_SOURCE_DIR "/studio/page";

std::string outputOf(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) out.append(buffer.data(), n);
  return pclose(pipe) == 0 ? out : std::string();
}

class PageMotion : public testing::Test {
 protected:
  void SetUp() override {
    const bool has_page = fs::exists(kPage + "/motion.js") && fs::exists(kPage + "/frames.js");
    if (!has_page || outputOf("node --version 2>/dev/null").empty()) {
      if (std::getenv("CAROM_REQUIRE_THREE") != nullptr) FAIL() << "node or studio/page is missing";
      GTEST_SKIP() << "node or studio/page is missing";
    }
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Poses of every body at the times, as the page has them.
  json played(const Motion& motion, const std::vector<double>& times) const {
    const std::string frame = (folder_ / "frame").string(), list = (folder_ / "times.json").string();
    std::ofstream(frame, std::ios::binary) << studio::motionFrame(studio::viewOf(motion), R"({"rev": 1})");
    std::ofstream(list) << json(times).dump();
    const std::string script = CAROM_SOURCE_DIR "/tests/studio/page_motion.mjs";
    const std::string answer = outputOf("node '" + script + "' '" + kPage + "' '" + frame + "' '" + list + "'");
    EXPECT_FALSE(answer.empty());
    return answer.empty() ? json::array() : json::parse(answer);
  }

  void expectPage(const Motion& motion, std::uint64_t seed) const {
    test::Random random(seed);
    std::vector<double> times = {0, motion.end};
    for (int i = 0; i < kTimes; ++i) times.push_back(random.in(0, motion.end));
    const json poses = played(motion, times);
    ASSERT_EQ(poses.size(), motion.scene->bodies.size());
    for (std::size_t body = 0; body < poses.size(); ++body)
      for (std::size_t k = 0; k < times.size(); ++k) {
        expectPose(motion, static_cast<int>(body), times[k], poses[body].at(k).get<std::array<double, 10>>());
        if (testing::Test::HasFailure()) return;  // one is enough
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
};

TEST_F(PageMotion, IsTheMotionOfEveryExample) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(CAROM_SOURCE_DIR "/examples/scenes")) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const Document document = readDocument(entry.path().string());
    OdeContacts contacts(document.scene);
    expectPage(simulate(document.scene, contacts, document.duration), 6);
    ++scenes;
  }
  EXPECT_GE(scenes, 20);
}

TEST_F(PageMotion, IsTheMotionOfWhatLasts) {
  for (const test::DotProductScene& row : test::lastingScenes()) {
    SCOPED_TRACE(row.name);
    expectPage(test::motionOf(row), 7);
  }
}

}  // namespace
}  // namespace carom::studio_test
