// SPDX-License-Identifier: MIT
#include "adjoint/motion/start_overlap.h"

#include <sstream>

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/errors.h"

namespace carom {

using namespace adjoint_detail;

namespace {

const std::string& nameAt(const Scene& scene, int body) {
  return scene.bodies[checkedIndex("an overlap", "body", body, scene.bodies.size())].name;
}

}  // namespace

void refuseOverlap(const Scene& scene, const StartOverlap& overlap) {
  std::ostringstream text;
  text << "found '" << nameAt(scene, overlap.a) << "' and '" << nameAt(scene, overlap.b) << "' overlapping by "
       << overlap.depth << " m at the start, expected bodies apart or touching";
  throw InputError("/bodies/" + std::to_string(overlap.b), text.str());
}

std::string describeOverlapAtStart(const Scene& scene, const StartOverlap& overlap) {
  std::ostringstream text;
  text << "'" << nameAt(scene, overlap.a) << "' and '" << nameAt(scene, overlap.b) << "' overlap by " << overlap.depth
       << " m at the start: they do not collide until they have parted";
  return text.str();
}

std::string describeOverlap(const Scene& scene, const StartOverlap& overlap) {
  std::ostringstream text;
  text << "'" << nameAt(scene, overlap.a) << "' and '" << nameAt(scene, overlap.b) << "' overlap by " << overlap.depth
       << " m at the start and ";
  if (overlap.parted) {
    text << "part at t = " << *overlap.parted << " s: until then they do not collide";
  } else {
    text << "do not part: they do not collide";
  }
  return text.str();
}

}  // namespace carom
