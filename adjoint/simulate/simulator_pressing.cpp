// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "adjoint/simulate/contact_acceleration.hpp"
#include "adjoint/simulate/simulator.hpp"

// Contacts after which a motion cannot go on, though velocities and forces along normals do not tell.

namespace carom::adjoint_detail {
namespace {

// Accelerations towards each other above this share of the largest one press.
constexpr double kPressing = 1e-9;

}  // namespace

// What friction slows down may press on what touches it, which forces along the normals do not tell.
void Simulator::endWherePressed() {
  const double time = draft_.event.time;
  double pull = 0;
  const auto sideOf = [&](int body) -> ContactSide {
    const State& s = stateAfter(body);
    Arc& arc = pathOf(body);
    arc.extendTo(time);
    const StateDerivative rate = arc.rateAt(time, s);
    const Mat3 A = (*motion_.models)[index(body)].inverseInertiaWorld(s.q.toRotationMatrix());
    pull = std::max(pull, rate.v.norm());
    return {s, FreeAcceleration{rate.v, A * (rate.L - (A * s.L).cross(s.L))}};
  };
  const auto rubs = [&](int body) { return !pathOf(body).isFlight() && pathOf(body).kind() != ArcKind::rest; };
  for (const Contact& c : draft_.event.contacts) {
    if (!c.lasts || !joinsMoved(c) || !(rubs(c.a) || rubs(c.b)) || !draft_.beyond.empty()) continue;
    const ContactSide a = sideOf(c.a), b = sideOf(c.b);
    if (gapAcceleration(motion_, c, a, b) < -kPressing * std::max(pull, scene_.gravity.norm()))
      endBeyond(c, "one of them would move, and motion on bodies that can move is not modelled yet");
  }
}

}  // namespace carom::adjoint_detail
