// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "adjoint/scene/scene.h"
#include "tests/pairs/separation.h"
#include "tests/support/brute/flight.h"

namespace carom::pairs {

/// The first impact of two bodies.
struct FirstImpact {
  Real time = 0;
  Touch touch;           ///< normal from the scene's body 1 to body 0
  Real approach = 0;     ///< n . u, m/s, < 0
  Real speed = 0;        ///< |u|
  std::string features;  ///< in words
  Candidate nearest;     ///< the same
  /// Why the answer is not fit to be compared with: two feature pairs within a nanosecond, a border of a feature
  /// within a nanometre, a grazing touch. Empty for nearly all.
  std::string doubt;
};

/// Two bodies on their way, in long double, with nothing of the program under test.
class Encounter {
 public:
  static constexpr Real kTie = 1e-9L;  // s and m

  /// Of a scene with two bodies.
  explicit Encounter(const Scene& scene);

  /// Follows them by steps that cannot pass a contact, down to a distance of 1e-13 m, and solves for the zero of the
  /// smooth gap of the features that are nearest there. Steps are no longer than (proven distance) / (bound on the
  /// speed); or, near a contact, than the time for which slabs between the pieces are proven to stay open. `patient`
  /// takes the former alone.
  std::optional<FirstImpact> firstImpact(Real until, bool patient = false);

  /// Distance at a time.
  Distance distanceAt(Real t, const Known& known = {});
  /// Gap of given features, and its rate n . u.
  struct Gap {
    Touch touch;
    Real rate = 0, speed = 0;
  };
  std::optional<Gap> gapAt(const Candidate& features, Real t);
  /// Time near `from` at which the gap of given features is least: its rate is 0.
  std::optional<Real> leastGap(const Candidate& features, Real from);

  /// Features and time of the smallest distance that a step of firstImpact has seen.
  const Candidate& closest() const { return closest_; }
  Real closestTime() const { return closest_time_; }

  long steps() const { return steps_; }
  /// Largest (distance - proven distance) / distance of all steps taken at 1e-6 to 1 m.
  Real worstProof() const { return worst_proof_; }

 private:
  struct Side {
    brute::MassProperties mass;
    brute::Flight flight;
    Solid solid;
    Placed placed;
    Real reach;  // about the centre of mass
    brute::Kinematic state;
  };
  static Side sideOf(const Scene& scene, const Body& body);
  void moveTo(Real t);
  Real ballGap() const;
  Real safeStep(Real distance) const;
  static Drift driftOf(const Side& side);
  Real longStep(Real distance, const Candidate& nearest) const;
  Real speed() const;
  Real travelIn(Real h) const;
  FirstImpact impactOf(const Candidate& nearest, Real now);
  std::optional<Real> zeroOf(const Candidate& features, Real from);
  bool standsAlone(const Candidate& chosen, Real within);
  std::string doubtOf(const Candidate& chosen, const FirstImpact& impact);

  Side a_, b_;
  long steps_ = 0;
  Real worst_proof_ = 0;
  Candidate closest_;
  Real closest_time_ = 0;
};

}  // namespace carom::pairs
