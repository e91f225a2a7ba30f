// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/scene/body_model.h"
#include "tests/random/solid.h"
#include "tests/support/brute/flight.h"

namespace carom::brute {

/// Impacts by looking at every pair of bodies all the time, with nothing of the program under test: neither its shapes
/// and gaps nor its flights nor its bounds.
///
/// A pair is sampled at least every 2 ms, and as densely as it takes to be sure of the time between two samples: along
/// the direction that separates the solids now (turning as it turns now), every corner is followed to first order with
/// a bound on its second derivative, and the next sample is no later than the time at which that could bring them
/// together. Only where this would need steps below kShortest is one of that length taken instead; so what can be
/// missed is a touch that lasts less than 1e-12 s, some 1e-11 m deep at the speeds of these scenes. A sample that
/// overlaps is followed by bisection.
class BruteForce {
 public:
  static constexpr Real kShortest = 1e-12L, kLongest = 2e-3L;  // s

  explicit BruteForce(const Scene& scene);

  /// Body flies on from `state` at time t; its pairs are looked at afresh.
  void restart(int body, Real t, const State& state);
  /// The pair has just had an impact: rounding of the state left a gap or an overlap, by twice of which the bodies have
  /// to come apart before they can be seen to meet.
  void leaveContact(int a, int b, Real t);
  /// Whether they have come apart since.
  bool hasParted(int a, int b);

  /// Looks at all pairs up to t.
  void lookUntil(Real t);
  /// Looks at one pair up to t; time of its first touch if there is one.
  std::optional<Real> lookAt(int a, int b, Real t);

  struct Touch {
    int a, b;
    Real time;
  };
  /// Touches found so far, on the present flights.
  std::vector<Touch> touches() const;

  Kinematic stateAt(int body, Real t) { return body_(body).flight.at(t); }
  Separation separationAt(int a, int b, Real t);
  const MassProperties& mass(int body) const { return bodies_[static_cast<std::size_t>(body)].mass; }
  const Solid& solid(int body) const { return bodies_[static_cast<std::size_t>(body)].solid; }
  std::size_t samples() const { return samples_; }

 private:
  struct BruteBody {
    Solid solid;
    MassProperties mass;
    Flight flight;
  };
  struct Pair {
    int a, b;
    Real at = 0, next = 0;  // last sample; time of the next one
    Real slack = 0;         // contact at the start: separations below this are not yet apart
    bool apart = false;
    bool sampled = false;
    std::optional<Real> touch;
  };

  BruteBody& body_(int i) { return bodies_[static_cast<std::size_t>(i)]; }
  Pair& pair(int a, int b);
  void look(Pair& p, Real until);
  void sample(Pair& p, Real t);
  Real safeStep(const Pair& p, Real t, const Separation& s, bool as_balls, Real slack);
  Vector turning(const Pair& p, Real t, const Separation& s);
  Real bisect(const Pair& p, Real before, Real after, Real level);
  /// Separation of bounding balls when that is ample.
  std::optional<Separation> farApart(const Pair& p, Real t);

  Vector gravity_;
  std::vector<BruteBody> bodies_;
  std::vector<Pair> pairs_;
  std::size_t samples_ = 0;
};

}  // namespace carom::brute
