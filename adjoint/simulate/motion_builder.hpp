// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "adjoint/base/errors.h"
#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

/// Makes a motion, event by event: what `simulate`, which finds the events, and `simulateAlong`, which knows them, do
/// alike.
class MotionBuilder {
 public:
  /// Scene, models and duration of the motion; plan and geometry are still to be set.
  MotionBuilder(const Scene& scene, double duration);

  Motion motion;

  /// The first arc of every body.
  void start();
  /// Kinematic bodies keep to these. Throws InputError for another body.
  void give(const std::map<int, std::shared_ptr<Trajectory>>& trajectories);
  /// The same as in another motion.
  void giveAs(const Motion& like);
  /// A flight of a body from a state on, or what it keeps to.
  Arc flight(int body, double time, const State& state) const;

  /// Fills in the contact at the features of `contact`, where its bodies are at `a` and `b`: geometry, the normal of the
  /// impulse with its tilts, approach.
  void place(Contact& contact, const Kinematics& a, const Kinematics& b) const;
  /// The same of a rim that lies flat, whose lowest point follows from how it moves.
  void placeMoving(Contact& c, const Kinematics& a, const Kinematics& b) const;
  /// Approach and surface velocity of a contact that has its place.
  void setVelocities(Contact& c, const Kinematics& a, const Kinematics& b) const;
  /// The coefficients of two bodies.
  PairCoefficients pairOf(int a, int b) const { return combine(*material_[index(a)], *material_[index(b)]); }
  /// The first contact whose bodies go on into one another, as an impulse along a tilted normal may make them; null
  /// where there is none.
  const Contact* notParted(const Event& event, const std::vector<State>& after) const;

  /// Adds an event, and the arcs of its participants from then on, but of those that stay.
  void add(Event&& event, std::vector<Arc>&& arcs);
  /// The status and the message of a motion that ends where the flight of a body cannot be followed.
  void endFlight(std::size_t body, const NotComputable& why);

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::vector<const Material*> material_;  // a body each
  std::map<int, std::shared_ptr<Trajectory>> given_;
};

}  // namespace carom::adjoint_detail
