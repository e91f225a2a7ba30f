// SPDX-License-Identifier: MIT
#include "tests/export/players.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "examples/support/project_file.h"
#include "formats/base/document.h"
#include "adjoint/simulate/simulate.h"
#include "ode_bridge/ode_contacts.h"

namespace carom::export_tests {

std::string outputOf(const std::string& command) {
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return out;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) out.append(buffer.data(), n);
  return pclose(pipe) == 0 ? out : std::string();
}

std::string quoted(const std::string& path) {
  std::string out = "'";
  for (const char c : path) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> exampleScenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(projectFile("examples/scenes")))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Motion simulated(const Document& document) {
  OdeContacts contacts(document.scene);
  return simulate(document.scene, contacts, document.duration);
}

namespace {

struct Pose {
  Vec3 x;
  Quat q;
};

Pose poseOf(const nlohmann::json& numbers, bool y_up) {
  std::array<double, 7> v{};
  for (std::size_t i = 0; i < 7; ++i) v[i] = numbers.at(i).get<double>();
  if (y_up) return {{v[0], -v[2], v[1]}, {v[3], v[4], -v[6], v[5]}};
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
}

/// The fastest within a time about t, where an impact may be: m/s of the origin, and rad/s.
struct Speeds {
  double move = 0, turn = 0;
};

Speeds speedsAbout(const Motion& motion, const std::string& body, double t, double time) {
  Speeds out;
  const double arm = (*motion.models)[static_cast<std::size_t>(bodyIndex(*motion.scene, body))].center.norm();
  for (const double at : {t - time, t, t + time}) {
    const BodyState state = motion.stateAt(body, std::clamp(at, 0.0, motion.end));
    out.turn = std::max(out.turn, state.angular_velocity.norm());
    out.move = std::max(out.move, state.velocity.norm() + arm * state.angular_velocity.norm());
  }
  return out;
}

struct Worst {
  double move = 0, turn = 0;
  void add(double m, double t) { move = std::max(move, m), turn = std::max(turn, t); }
};

}  // namespace

void expectPlays(const Played& played, const Motion& motion, const PlayBounds& bounds) {
  Worst on_frames, on_all;
  for (const Body& body : motion.scene->bodies) {
    if (body.fixed) continue;
    if (!played.poses.contains(body.name)) {
      ADD_FAILURE() << "the player has no " << body.name;
      continue;
    }
    const auto& poses = played.poses.at(body.name);
    EXPECT_TRUE(!poses.empty());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const double t = std::min(static_cast<double>(k) * played.step, motion.end);
      const Pose pose = poseOf(poses[k], played.y_up);
      const BodyState state = motion.stateAt(body.name, t);
      const double move = (pose.x - state.position).norm(), turn = pose.q.angularDistance(state.orientation);
      const bool on_frame = k % static_cast<std::size_t>(played.steps_a_frame) == 0;
      const Speeds speeds = bounds.time > 0 ? speedsAbout(motion, body.name, t, bounds.time) : Speeds{};
      EXPECT_TRUE(move <= (on_frame ? bounds.frame_moves : bounds.between_moves) + bounds.time * speeds.move)
          << body.name << " at " << t << " s: " << move << " m off";
      EXPECT_TRUE(turn <= (on_frame ? bounds.frame_turns : bounds.between_turns) + bounds.time * speeds.turn)
          << body.name << " at " << t << " s: " << turn << " rad off";
      if (on_frame) on_frames.add(move, turn);
      on_all.add(move, turn);
      if (testing::Test::HasFailure()) return;  // one is enough
    }
  }
  testing::Test::RecordProperty("frame_um", std::to_string(1e6 * on_frames.move));
  testing::Test::RecordProperty("frame_urad", std::to_string(1e6 * on_frames.turn));
  testing::Test::RecordProperty("between_um", std::to_string(1e6 * on_all.move));
  testing::Test::RecordProperty("between_urad", std::to_string(1e6 * on_all.turn));
}

}  // namespace carom::export_tests
