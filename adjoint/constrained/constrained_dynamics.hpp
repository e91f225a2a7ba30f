// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_contact.hpp"
#include "adjoint/numeric/dual.hpp"

/// The forces at contacts that last, and what the body does under them: (11.19) to (11.22) of docs/equations.md.
namespace carom::adjoint_detail {

/// A contact as the body meets it at one instant.
template <class S>
struct ContactInstant {
  ContactMode mode = ContactMode::sticks;
  V3<S> n, r;                   ///< normal towards the body; from its centre of mass to the contact
  V3<S> normal_rate;            ///< of n
  V3<S> point_rate;             ///< of the place of the contact
  V3<S> support_velocity = V3<S>::Zero();      ///< of the material of the other body there, 0 where it stands still
  V3<S> support_acceleration = V3<S>::Zero();  ///< d/dt of that
  S friction = 0;
  V3<S> slip = V3<S>::Zero();   ///< unit direction of its slip, where it slides

  /// Of the force by that of its normal, where it slides.
  V3<S> push() const { return n - friction * slip; }
};

/// The body at that instant.
template <class S>
struct BodyInstant {
  V3<S> v, L, omega, gravity;
  M3<S> A;                      ///< inverse inertia, world axes
  S inverse_mass = 0;

  V3<S> velocityAt(const V3<S>& r) const { return v + omega.cross(r); }
  /// Against the material of the other body.
  V3<S> relativeVelocity(const ContactInstant<S>& c) const { return velocityAt(c.r) - c.support_velocity; }
};

/// The unknown forces y of all contacts (three numbers where one sticks, along the push of its normal force and its
/// friction where it slides) solve B y = -b.
class ConstrainedDynamics {
 public:
  /// `redundant`: B may not have full rank, and y is of least norm. `inverse`: is given B^+.
  ConstrainedDynamics(const BodyInstant<double>& body, const std::vector<ContactInstant<double>>& contacts, bool redundant,
               Eigen::MatrixXd* inverse = nullptr);

  /// On the body.
  const Vec3& force(std::size_t k) const { return force_[k]; }
  double pressing(std::size_t k) const { return contacts_[k].n.dot(force_[k]); }
  const Eigen::MatrixXd& matrix() const { return B_; }
  const Eigen::VectorXd& solution() const { return y_; }
  const Eigen::VectorXd& withoutForces() const { return b_; }
  Eigen::Index unknown(std::size_t k) const { return first_[k]; }

  Vec3 acceleration() const;
  Vec3 moment() const;
  Vec3 spinRate() const { return body_.A * Vec3(moment() - body_.omega.cross(body_.L)); }
  /// d/dt of the velocity of the body against what it touches there; also of a contact that has no force.
  Vec3 slipRate(std::size_t k) const;
  Vec3 slipRateAt(const ContactInstant<double>& c) const {
    return acceleration() + spinRate().cross(c.r) + body_.omega.cross(Vec3(c.point_rate - body_.v)) - c.support_acceleration;
  }
  /// d^2(gap)/dt^2.
  double gapAcceleration(const ContactInstant<double>& c) const {
    return c.n.dot(slipRateAt(c)) + c.normal_rate.dot(body_.relativeVelocity(c));
  }
  /// How all forces answer as the direction of slip at contact l turns about its normal, by 1 rad.
  std::vector<Vec3> answerToTurn(std::size_t l, bool redundant) const;
  /// How the velocity at an arm answers to a force at contact l.
  Vec3 responseAt(const Vec3& r, std::size_t l, const Vec3& f) const {
    const Vec3 spin = body_.A * contacts_[l].r.cross(f);
    return f * body_.inverse_mass + spin.cross(r);
  }
  /// The same to forces at all contacts.
  Vec3 responseAt(const Vec3& r, const std::vector<Vec3>& forces) const;

 private:
  std::vector<Vec3> forcesOf(const Eigen::VectorXd& y) const;
  void fill(std::size_t k, std::size_t l);

  const BodyInstant<double>& body_;
  const std::vector<ContactInstant<double>>& contacts_;
  std::vector<Eigen::Index> first_;
  std::vector<Vec3> free_, force_;
  Eigen::MatrixXd B_;
  Eigen::VectorXd b_, y_;
};

}  // namespace carom::adjoint_detail
