// SPDX-License-Identifier: MIT
#include "adjoint/motion/start_overlap.h"

#include "adjoint/base/arguments.hpp"
#include "adjoint/base/refuse.hpp"

namespace carom {

using namespace adjoint_detail;

namespace {

const std::string& nameAt(const Scene& scene, int body) {
  return scene.bodies[checkedIndex("an overlap", "body", body, scene.bodies.size())].name;
}

std::string bodiesAndDepth(const Scene& scene, const StartOverlap& overlap, const char* overlapping) {
  return textOf(6, "'", nameAt(scene, overlap.a), "' and '", nameAt(scene, overlap.b), "' ", overlapping, " by ",
                overlap.depth, " m at the start");
}

}  // namespace

void refuseOverlap(const Scene& scene, const StartOverlap& overlap) {
  throw InputError("/bodies/" + std::to_string(overlap.b),
                   "found " + bodiesAndDepth(scene, overlap, "overlapping") + ", expected bodies apart or touching");
}

std::string describeOverlapAtStart(const Scene& scene, const StartOverlap& overlap) {
  return bodiesAndDepth(scene, overlap, "overlap") + ": they do not collide until they have separated";
}

std::string describeOverlap(const Scene& scene, const StartOverlap& overlap) {
  return bodiesAndDepth(scene, overlap, "overlap") +
         (overlap.parted ? textOf(6, " and separate at t = ", *overlap.parted, " s: until then they do not collide")
                         : " and do not separate: they do not collide");
}

}  // namespace carom
