// SPDX-License-Identifier: MIT
#include "tests/reference/constrained_along.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace carom::reference {

using adjoint_detail::PersistentContact;
using adjoint_detail::ConstrainedInstant;
using adjoint_detail::ContactMode;
using adjoint_detail::ConstrainedPath;

namespace {
const Real kNothing("1e-16");  // s: what is left of a slip then
}

std::vector<ConstrainedSpan> constrainedPathsOf(const Motion& motion) {
  std::vector<ConstrainedSpan> paths;
  const auto& arcs = motion.world_lines[0].arcs;
  for (std::size_t a = 0; a < arcs.size(); ++a) {
    const auto* path = arcs[a].trajectory().constrained();
    if (!path || path->allSteps().empty() || !(path->allSteps().front().length > 0)) continue;
    paths.push_back({path, a, std::min(a + 1 < arcs.size() ? arcs[a + 1].start() : motion.end, path->knownUntil())});
  }
  return paths;
}

ConstrainedState stateOf(const BodyModel& model, const State& s) {
  const BodyState b = toBodyState(model, s);
  return {RVec(s.x), rotationOf(s.q), RVec(s.v), RVec(b.angular_velocity)};
}

ConstrainedBody bodyOf(const ConstrainedPath& path) {
  const BodyModel& model = *path.scene().model;
  return {Real(model.mass), RVec(model.inertia), RVec(path.scene().gravity)};
}

std::vector<ConstrainedCorner> cornersOf(const ConstrainedPath& path, const Vec3& size) {
  const State start = path.stateAt(path.start());
  const ConstrainedInstant now = path.instantAt(path.start());
  std::vector<ConstrainedCorner> corners;
  for (std::size_t k = 0; k < path.contacts().size(); ++k) {
    const PersistentContact& c = path.contacts()[k];
    const Vec3 arm = start.q.conjugate() * now.contacts[k].r;
    ConstrainedCorner corner;
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(std::abs(arm[i]) - size[i] / 2) <= 1e-9)) throw std::runtime_error("what holds a box is not its corner");
      corner.at[i] = Real(arm[i] > 0 ? 1 : -1) * Real(size[i]) / 2;
    }
    corner.normal = unit(RVec(now.contacts[k].n));
    corner.offset = dot(corner.normal, RVec(start.x) + rotationOf(start.q) * corner.at);
    corner.friction = c.friction;
    corner.sticks = c.mode == ContactMode::sticks, corner.begins = c.begins, corner.slip = RVec(c.slip);
    corners.push_back(corner);
  }
  return corners;
}

ConstrainedAlong::ConstrainedAlong(const ConstrainedBody& body, std::vector<ConstrainedCorner> corners, const ConstrainedState& start, const Real& time,
                     int order, const Real& tolerance)
    : series_(body, corners, projected(body, corners, start), order, tolerance), time_(time) {}

// No more than a third of a slip that comes to its end: what converges about its middle may not do so at its end.
Real ConstrainedAlong::next() const {
  Real longest = series_.longest();
  for (std::size_t k = 0; k < series_.corners().size(); ++k) {
    const RVec u = series_.slip(k, 0), rate = series_.slipRate(k);
    if (!series_.corners()[k].sticks && dot(u, rate) < 0) longest = std::min<Real>(longest, norm(u) / norm(rate) / 3);
  }
  return longest;
}

ConstrainedState ConstrainedAlong::at(const Real& time) {
  Real left = time - time_;
  for (Real step = next(); step < left && step > kNothing; step = next())
    series_.advance(step), time_ += step, left -= step;
  return series_.at(std::min<Real>(left, next()));
}

}  // namespace carom::reference
