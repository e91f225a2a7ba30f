// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/reference/gaps.h"
#include "tests/reference/identify.h"
#include "tests/reference/impact.h"
#include "tests/reference/replay.h"
#include "tests/reference/rotation.h"

namespace carom::reference {

/// State of a body, at the shape's origin; R turns shape axes into world axes.
struct RealState {
  RVec position;
  RMat R;
  RVec velocity, spin;
};

/// Free flight of one body from `start` on; a fixed body has one flight, and no rotation.
struct Flight {
  Real start = 0;
  RVec x, v;
  std::shared_ptr<FreeRotation> rotation;
};

/// An impact with everything frozen that has to be when its causes vary.
struct FrozenImpact {
  int a = -1, b = -1;
  Features features;
  ImpactMode mode = ImpactMode::frictionless;
  int tilt = -1;      ///< entry of the scene's tilts in force
  Real time;
  int flight_a = 0, flight_b = 0;  ///< flights that end here
  RVec impulse;
};

/// All flights of a scene up to the last impact that was applied.
class WorldLines {
 public:
  /// Rotations that are equal to those of `known` are shared with it, since their series are the dear part.
  explicit WorldLines(SceneNumbers numbers, const WorldLines* known = nullptr)
      : numbers_(std::move(numbers)), known_(known), flights_(numbers_.bodies.size()) {
    for (int i = 0; i < bodies(); ++i) {
      const BodyNumbers& body = numbers_.bodies[i];
      if (!body.moving) {
        flights_[i].push_back({0, body.position, {}, nullptr});
        continue;
      }
      const RMat R = body.orientation * body.axes;
      const RVec L = R * times(body.inertia(), transposeTimes(R, body.spin));
      push(i, 0, body.position, body.velocity, R, L);
    }
  }

  int bodies() const { return static_cast<int>(flights_.size()); }
  const SceneNumbers& numbers() const { return numbers_; }
  int lastFlight(int body) const { return static_cast<int>(flights_[body].size()) - 1; }
  int flightAt(int body, const Real& t) const {
    int k = lastFlight(body);
    while (k > 0 && flights_[body][k].start > t) --k;
    return k;
  }

  RealState stateAt(int body, int flight, const Real& t) const {
    const BodyNumbers& n = numbers_.bodies[body];
    const Flight& f = flights_[body][flight];
    if (!n.moving) return {n.position, n.orientation, {}, {}};
    const Real s = t - f.start;
    const RMat R = f.rotation->orientationAt(s);
    const RVec g = n.gravity_factor * numbers_.gravity;
    return {f.x + s * f.v + (s * s / 2) * g, R * transpose(n.axes), f.v + s * g,
            f.rotation->spinAt(R)};
  }
  Placed placedAt(int body, const Real& t) const {
    const RealState s = stateAt(body, lastFlight(body), t);
    return {&numbers_.bodies[body], s.position, s.R};
  }

  /// Recognises the features that touch, on the flights so far.
  FrozenImpact recognise(const Impact& impact) const {
    FrozenImpact f;
    f.a = impact.a, f.b = impact.b, f.time = impact.time;
    f.features = identify(placedAt(f.a, f.time), placedAt(f.b, f.time), impact.point, impact.normal);
    for (std::size_t i = 0; i < numbers_.tilts.size(); ++i) {
      const TiltNumbers& tilt = numbers_.tilts[i];
      if ((tilt.body != f.a && tilt.body != f.b) || tilt.impact != lastFlight(tilt.body) + 1) continue;
      if (f.tilt >= 0) throw std::runtime_error("the reference knows only one tilt an impact");
      f.tilt = static_cast<int>(i);
    }
    return f;
  }

  /// Finds the exact time of an impact near f.time (unless frozen) and applies it; `decide` finds the mode as well.
  void apply(FrozenImpact& f, ImpactTimes times, bool decide) {
    f.flight_a = lastFlight(f.a), f.flight_b = lastFlight(f.b);
    if (times == ImpactTimes::follow) solveTime(f);
    const RealState A = stateAt(f.a, f.flight_a, f.time), B = stateAt(f.b, f.flight_b, f.time);
    const Touch touch =
        touchOf({&numbers_.bodies[f.a], A.position, A.R}, {&numbers_.bodies[f.b], B.position, B.R}, f.features);
    Side a = sideOf(f.a, A, touch.point), b = sideOf(f.b, B, touch.point);
    a.surface = numbers_.bodies[f.a].surfaceVelocity(A.position, A.R, touch.point, touch.normal);
    b.surface = numbers_.bodies[f.b].surfaceVelocity(B.position, B.R, touch.point, touch.normal);
    if (decide && !(dot(touch.normal, a.pointVelocity() - b.pointVelocity()) < 0)) {
      throw std::runtime_error("the bodies of an impact do not approach");
    }
    f.impulse = impulseOf(a, b, impulseNormal(f, touch.normal), coefficients(f), f.mode, decide);
    strike(f.a, a, f, A, f.impulse);
    strike(f.b, b, f, B, -f.impulse);
  }

  Touch touchAt(const FrozenImpact& f, const Real& t) const {
    return touchOf(placedAt(f.a, t), placedAt(f.b, t), f.features);
  }

 private:
  void push(int body, const Real& t, const RVec& x, const RVec& v, const RMat& R, const RVec& L) {
    auto rotation = std::make_shared<FreeRotation>(numbers_.bodies[body].inertia(), R, L);
    const std::size_t k = flights_[body].size();
    if (known_ && k < known_->flights_[body].size() && known_->flights_[body][k].rotation->sameAs(*rotation)) {
      rotation = known_->flights_[body][k].rotation;
    }
    flights_[body].push_back({t, x, v, rotation});
  }

  Side sideOf(int body, const RealState& s, const RVec& point) const {
    const BodyNumbers& n = numbers_.bodies[body];
    Side side;
    side.moving = n.moving;
    if (!n.moving) return side;
    if (!n.kinematic) {
      side.inverse_mass = 1 / n.mass();
      const RVec inertia = n.inertia();
      for (int i = 0; i < 3; ++i) side.inverse_inertia[i] = 1 / inertia[i];
    }
    side.R = s.R * n.axes;
    side.arm = point - s.position;
    side.velocity = s.velocity, side.spin = s.spin;
    return side;
  }

  /// Newton on the gap; its rate is n.u.
  void solveTime(FrozenImpact& f) const {
    for (int i = 0; i < 60; ++i) {
      const RealState A = stateAt(f.a, f.flight_a, f.time), B = stateAt(f.b, f.flight_b, f.time);
      const Touch touch =
          touchOf({&numbers_.bodies[f.a], A.position, A.R}, {&numbers_.bodies[f.b], B.position, B.R}, f.features);
      const RVec u = sideOf(f.a, A, touch.point).pointVelocity() - sideOf(f.b, B, touch.point).pointVelocity();
      const Real change = -touch.gap / dot(touch.normal, u);
      f.time += change;
      // below 1e-30 the next change, which is not made, would be its square
      if (abs(change) < 1e-30) return;
    }
    throw std::runtime_error("Newton's method does not find the time of an impact");
  }

  Coefficients coefficients(const FrozenImpact& f) const {
    const auto of = [this](int body) {
      const int m = numbers_.bodies[body].material;
      return m < 0 ? MaterialNumbers() : numbers_.materials[m];
    };
    return combined(of(f.a), of(f.b));
  }

  /// n is tilted as seen by the named body, towards which it points.
  RVec impulseNormal(const FrozenImpact& f, const RVec& n) const {
    if (f.tilt < 0) return n;
    const TiltNumbers& tilt = numbers_.tilts[f.tilt];
    return tilt.body == f.a ? tilted(n, tilt.value) : -tilted(-n, tilt.value);
  }

  void strike(int body, const Side& side, const FrozenImpact& f, const RealState& s, const RVec& P) {
    if (!side.moving) return;
    const RVec L = side.R * times(numbers_.bodies[body].inertia(), transposeTimes(side.R, side.spin));
    if (numbers_.bodies[body].kinematic) return push(body, f.time, s.position, s.velocity, side.R, L);
    push(body, f.time, s.position, s.velocity + side.inverse_mass * P, side.R, L + cross(side.arm, P));
  }

  SceneNumbers numbers_;
  const WorldLines* known_;
  std::vector<std::vector<Flight>> flights_;
};

}  // namespace carom::reference
