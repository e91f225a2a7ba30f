// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom::export_tests {

/// Runs a command of the shell and returns what it printed on standard output; nothing when it failed.
std::string outputOf(const std::string& command);

/// A path as one word for the shell.
std::string quoted(const std::string& path);

/// Names of the documents in examples/scenes, without ".json".
std::vector<std::string> exampleScenes();

/// The motion of an example as it stands.
Motion simulated(const Document& document);

/// Poses of named things at multiples of a step, [x, y, z, qw, qx, qy, qz] each, as a player has them.
struct Played {
  nlohmann::json poses;
  double step = 0;
  bool y_up = false;
  int steps_a_frame = 1;
};

/// How far a player may be off, in metres and radians.
struct PlayBounds {
  double frame_moves = 0, frame_turns = 0;      ///< on whole frames
  double between_moves = 0, between_turns = 0;  ///< on all steps
  double time = 0;                              ///< s: and as far as a body moves and turns in this time
};

/// Expects every moving body at every step where the motion has it. Records the worst, seen with --gtest_output=xml.
void expectPlays(const Played& played, const Motion& motion, const PlayBounds& bounds);

}  // namespace carom::export_tests
