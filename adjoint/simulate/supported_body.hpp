// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/constrained/constrained_modes.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"

namespace carom::adjoint_detail {

/// A moving body at a time and its contacts with fixed and kinematic bodies that part without speed: which of them press, and
/// what follows from where they are.
class SupportedBody {
 public:
  SupportedBody(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& closed, double time);

  const Vec3& gravity() const { return gravity_; }
  const Vec3& spin() const { return omega_; }
  double reach() const { return reach_; }  ///< the longest arm of a contact, m
  /// Of the closed contacts, those that a force without friction has to keep closed, and what stands with them.
  const std::vector<const Contact*>& pressed() const { return pressed_; }
  /// These press instead.
  void hold(const std::vector<const Contact*>& contacts) {
    pressed_ = contacts;
    carriers_.reset();
    for (const Contact* c : contacts) reach_ = std::max(reach_, armOf(*c).norm());
  }
  /// While such forces act.
  const FreeAcceleration& acceleration() const { return acceleration_; }

  int otherOf(const Contact& c) const { return c.a == body_ ? c.b : c.a; }
  Vec3 armOf(const Contact& c) const { return c.at.point - state_.x; }
  Vec3 normalOf(const Contact& c) const { return (c.a == body_ ? 1 : -1) * c.at.normal; }  ///< towards the body
  Vec3 slipOf(const Contact& c) const {
    const Vec3 u = state_.v + omega_.cross(armOf(c)), n = normalOf(c);
    return u - n.dot(u) * n;
  }
  ContactJacobian jacobianOf(const Contact& c) const;
  double height() const { return -armOf(*pressed_.front()).dot(normalOf(*pressed_.front())); }

  bool isBall() const;
  /// A cylinder or capsule that lies on its side, all of whose contacts are on the line below its axis.
  bool liesOnItsSide() const;
  /// The same, that turns about its axis alone.
  bool isAxle() const;
  Vec3 axis() const;  ///< of a cylinder or capsule, in the axes of its state
  /// What presses moves, or its surface does.
  bool isDriven() const;
  /// What presses is one face.
  bool isOneFace() const;
  /// Forces within the cones of friction undo gravity.
  bool canRest() const;
  /// What can rest rests however its velocities vary: contacts that bear a load oppose every motion.
  bool isConstrainedFirmly() const;

  PathInputs<double> inputs(double reach) const;
  PersistentContact candidate(const Contact& c) const;
  ConstrainedScene constrainedScene(const std::vector<const Contact*>& contacts) const;

 private:
  // What carries the weight of a body at rest, with the force that it bears.
  struct Carrier {
    Vec3 n, arm;  // towards the body; as a share of the reach
    double friction = 0;
    Vec3 force = Vec3::Zero();
  };
  const std::vector<Carrier>& carriers() const;
  std::vector<Carrier> whatCarries() const;
  void loadCarriers(std::vector<Carrier>& carriers) const;
  const Shape& shape() const { return motion_.scene->bodies[asIndex(body_)].shape; }
  void findPressed(const std::vector<const Contact*>& closed);
  /// A face stands on all of its corners, also on those that have no force, if they do not lift: without them it could
  /// tilt.
  std::vector<const Contact*> wholeFaces(const std::vector<const Contact*>& closed, const std::vector<int>& active,
                                         const std::vector<char>& stays) const;
  double freeGapAcceleration(const Contact& c) const;
  void push(const Eigen::Matrix<double, 6, 1>& acceleration);

  const Motion& motion_;
  int body_;
  const BodyModel& model_;
  const State& state_;
  Vec3 gravity_;
  double time_;
  Mat3 R_;
  Vec3 omega_;
  double reach_ = 0;
  std::vector<const Contact*> pressed_;
  mutable std::optional<std::vector<Carrier>> carriers_;  // of `pressed_`, once they were asked for
  FreeAcceleration acceleration_;
};

}  // namespace carom::adjoint_detail
