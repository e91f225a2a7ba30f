// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom::export_tests {

/// An impact of a moving body as the test wants it.
struct Bounce {
  double time;
  int body;
  int with;
  Vec3 velocity, angular_velocity;  ///< after it
};

/// A motion put together by hand, without a simulator: the bodies start as the scene says and change their velocities
/// at the bounces (in increasing order of time); the contact point is straight below the body's origin.
Motion handMotion(const Scene& scene, double duration, const std::vector<Bounce>& bounces);

/// A tumbling box (three different moments), a spinning ball and a top-like box over a floor, by a wall; two bounces of
/// the first body, one of the second, none of the third. 1.2 s.
Document handDocument();
Motion handMotion();

/// A path in the folder for temporary files, of its own for each test.
std::string temporaryPath(const std::string& name);
std::string contentOf(const std::string& path);

}  // namespace carom::export_tests
