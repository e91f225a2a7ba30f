// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/motion/motion.h"
#include "tests/reference/constrained_series.h"
#include "tests/reference/impact.h"
#include "tests/reference/rotation.h"

namespace carom::reference {

/// The numbers of a scene with a box that is thrown onto a plane.
struct DieNumbers {
  RVec gravity, x, v, spin, size, floor;  ///< floor: the place of the plane
  RMat R = RMat::identity(), floor_R = RMat::identity();
  Real elasticity, friction, mass;

  /// Body 0 the box, body 1 the plane z = 0 of its axes; one material.
  explicit DieNumbers(const Scene& scene);
  RVec normal() const { return floor_R.column[2]; }
  ConstrainedBody body() const;
};

/// A block that slides begins to tip.
struct UnknownTransition : std::runtime_error {
  UnknownTransition() : std::runtime_error("a transition that the reference does not know") {}
};

/// The box along the events of a motion: flights, impacts, and what corners hold in the modes that the motion has, in 50
/// digits; the law of several contacts in 32. Every arc begins and ends where the motion has it, to its last bit: bounces
/// amplify what was rounded in the first ones by so much that the derivative is another one where they end. What changes
/// with the numbers is carried on from arc to arc.
class DieReplay {
 public:
  /// `near`: the replay with the numbers of the motion itself, if these are others. Throws std::runtime_error where it is lost.
  DieReplay(const DieNumbers& numbers, const Motion& like, const DieReplay* near = nullptr);

  ConstrainedState end;            ///< where it rests, or after the last event
  std::vector<Real> when;           ///< of the events
  std::vector<ConstrainedState> before;  ///< just before them
  Real worst_position = 0, worst_velocity = 0;  ///< of the motion, from one place to the next

 private:
  void follow(const Event& event, const Arc& before, const DieReplay* near);
  void startArc(const Arc& arc, const Event* after);
  void settle(const Arc& arc, const Event& event);
  ConstrainedState at(const Real& time);  ///< on the present arc
  Real meet(const Event& event, Real guess, const Real& gap);
  std::array<Real, 2> meanGap(const Event& event, const ConstrainedState& s) const;  ///< and its rate
  std::vector<RVec> impulsesOf(const Event& event, const std::vector<RVec>& arms) const;
  void strike(const Event& event);
  Real endSlip(std::size_t corner);
  Real root(const Event& event, const Arc& arc, const Real& guess);
  Real value(TransitionCause cause, std::size_t corner, const Real& time);
  Real sharedRoom(std::size_t a, std::size_t b, const Real& s) const;
  Real gap(const RVec& corner, const ConstrainedState& s) const;
  RVec cornerOf(const Contact& contact) const;
  std::vector<ConstrainedCorner> cornersOf(const Arc& arc, const Event& after) const;

  /// Where the motion is before an event or at the start of an arc, and where the replay was led to.
  struct Place {
    Real time, time_led;
    ConstrainedState state, led;
  };
  void takeOver(const State& state, const BodyModel& model, const Real& time, const Place* near);

  const DieNumbers n_;
  std::vector<Place> places_;    // two of every event
  std::vector<Real> gaps_;       // that the motion has left where bodies meet, m
  Real arc_start_ = 0;
  ConstrainedBody body_;
  ConstrainedState state_;  // at start_, the start of the present arc or step
  Real start_ = 0;
  std::unique_ptr<FreeRotation> turning_;
  std::unique_ptr<ConstrainedSeries> held_;
};

}  // namespace carom::reference
