// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/carrier.hpp"
#include "adjoint/contact/rest_program.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"

namespace carom::adjoint_detail {

/// Bodies that impulses move, and the contacts between them and with what these do not move that part without speed: which of
/// these press, and whether forces hold all of the bodies (docs/equations.md, 11.30), in the frame of what carries them
/// (11.33).
class SupportedComponent {
 public:
  struct Member {
    int body = -1;
    State state;
  };
  SupportedComponent(const Motion& motion, std::vector<Member> members, std::vector<const Contact*> closed, double time);

  const std::vector<Member>& members() const { return members_; }
  /// Without those with what passes below the bodies (Carried::passing).
  const std::vector<const Contact*>& closed() const { return closed_; }
  /// Of the closed contacts, those that forces without friction have to keep closed, and those of the same faces.
  std::vector<const Contact*> pressed() const;
  /// Accelerations while such forces act, a member each.
  const std::vector<FreeAcceleration>& pressedAccelerations() const { return pressed_; }

  /// Whether forces within the cones of friction of these contacts undo all loads, and, where they do, what bears one.
  struct Rest {
    bool holds = false;                   ///< forces are enough
    bool opposed = false;                 ///< every motion slips or opens a contact that bears a load
    std::vector<const Contact*> bearing;  ///< contacts with a load
  };
  Rest restOn(const std::vector<const Contact*>& contacts) const;
  /// Whether impulses within these cones undo those that `struck` contacts give the bodies, but for speeds up to `slow` m/s.
  bool holdImpulses(const std::vector<const Contact*>& contacts, const std::vector<const Contact*>& struck, double slow) const;

  /// What carries them.
  const Carried& carried() const { return carried_; }
  /// Up to when, at the latest `until`, these contacts hold the bodies on their carrier: the loads turn in its frame, s.
  double heldUntil(const std::vector<const Contact*>& contacts, double until) const;

  double reachOf(std::size_t member) const { return reach_[member]; }  ///< the longest arm of a contact of it, m
  double speedOf(std::size_t member) const;  ///< m/s, and
  double spinOf(std::size_t member) const;  ///< rad/s: against the carrier

 private:
  int memberOf(int body) const;
  RestProgram programOf(const std::vector<const Contact*>& contacts) const;
  RestProgram loadedProgram(const std::vector<const Contact*>& contacts, const Vec3& gravity) const;
  double pullOf(const Vec3& gravity) const;  // the strongest on a member, m/s^2
  bool holds(const RestForces& forces) const;
  ContactSide sideOf(int body, const std::vector<FreeAcceleration>& accelerations) const;

  const Motion& motion_;
  double time_;
  std::vector<Member> members_;
  std::vector<const Contact*> closed_;
  Carried carried_;
  Carrier::Instant frame_;  // of the carrier, at rest without one
  std::vector<FreeAcceleration> free_, pressed_;
  std::vector<double> reach_;
  std::vector<char> presses_;  // of each of the closed ones
};

/// Poses of these bodies with all gaps of the contacts 0 at a time, moved as little as possible as measured by the masses (11.13); the
/// contacts follow.
void closeGaps(const Motion& motion, std::vector<SupportedComponent::Member>& members, std::vector<Contact>& closed, double time);

}  // namespace carom::adjoint_detail
