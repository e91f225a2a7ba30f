// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/QR>
#include <Eigen/LU>
#include <vector>

#include "adjoint/held/held_contact.hpp"
#include "adjoint/numeric/dual.hpp"

/// The forces at contacts that last, and what the body does under them, in any kind of number: (11.19) to (11.22) of
/// docs/equations.md.
namespace carom::adjoint_detail {

/// A contact as the body meets it at one instant.
template <class S>
struct ContactInstant {
  HeldMode mode = HeldMode::sticks;
  V3<S> n, r;                   ///< normal towards the body; from its centre of mass to the contact
  V3<S> normal_rate;            ///< of n
  V3<S> point_rate;             ///< of the place of the contact
  S friction = 0;
  V3<S> slip = V3<S>::Zero();   ///< unit direction of its slip, where it slides
};

/// The body at that instant.
template <class S>
struct BodyInstant {
  V3<S> v, L, omega, gravity;
  M3<S> A;                      ///< inverse inertia, world axes
  S inverse_mass = 0;

  V3<S> velocityAt(const V3<S>& r) const { return v + omega.cross(r); }
};

/// y = -B^+ b, of least norm where B has not full rank, with b in its range. `redundant`: it may not have it.
Eigen::VectorXd solveForces(const Eigen::MatrixXd& B, const Eigen::VectorXd& b, bool redundant,
                            Eigen::MatrixXd* inverse = nullptr);

/// The same with rates, at constant rank: dy = -B^+ (db + dB y) + (1 - B^+ B) dB^T B^+^T y.
template <int N>
VectorOf<Dual<N>> solveForces(const MatrixOf<Dual<N>>& B, const VectorOf<Dual<N>>& b, bool redundant) {
  Eigen::MatrixXd inverse;
  const Eigen::MatrixXd B0 = valuesOf(B);
  const Eigen::VectorXd y0 = solveForces(B0, valuesOf(b), redundant, &inverse);
  VectorOf<Dual<N>> y = y0.template cast<Dual<N>>();
  for (std::size_t i = 0; i < static_cast<std::size_t>(N); ++i) {
    const Eigen::MatrixXd dB = ratesOf(B, i);
    Eigen::VectorXd dy = -(inverse * (ratesOf(b, i) + dB * y0));
    if (redundant) {
      const Eigen::VectorXd turned = dB.transpose() * (inverse.transpose() * y0);
      dy += turned - inverse * (B0 * turned);
    }
    setRates(y, dy, i);
  }
  return y;
}

template <class S>
class HeldDynamics {
 public:
  HeldDynamics(const BodyInstant<S>& body, const std::vector<ContactInstant<S>>& contacts, bool redundant)
      : body_(body), contacts_(contacts) {
    const Eigen::Index n = static_cast<Eigen::Index>(contacts.size());
    Eigen::Index unknowns = 0;
    for (const auto& c : contacts) first_.push_back(unknowns), unknowns += c.mode == HeldMode::sticks ? 3 : 1;
    free_.resize(contacts.size());
    const V3<S> turning = body.A * body.L.cross(body.omega);  // of omega, without forces
    for (std::size_t k = 0; k < contacts.size(); ++k)
      free_[k] = body.gravity + turning.cross(contacts[k].r) +
                 body.omega.cross(V3<S>(contacts[k].point_rate - body.v));
    B_.resize(unknowns, unknowns);
    b_.resize(unknowns);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto& c = contacts[static_cast<std::size_t>(k)];
      const V3<S>& own = free_[static_cast<std::size_t>(k)];
      if (c.mode == HeldMode::sticks) {
        b_.template segment<3>(first(k)) = own;
      } else {
        b_[first(k)] = c.n.dot(own) + c.normal_rate.dot(body.velocityAt(c.r));
      }
      for (Eigen::Index l = 0; l < n; ++l) fill(k, l);
    }
    y_ = solveForces(B_, b_, redundant);
    force_.resize(contacts.size());
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto& c = contacts[static_cast<std::size_t>(k)];
      force_[static_cast<std::size_t>(k)] = c.mode == HeldMode::sticks ? V3<S>(y_.template segment<3>(first(k)))
                                                                       : V3<S>(pushOf(c) * y_[first(k)]);
    }
  }

  /// On the body.
  const V3<S>& force(std::size_t k) const { return force_[k]; }
  S pressing(std::size_t k) const { return contacts_[k].n.dot(force_[k]); }
  const MatrixOf<S>& matrix() const { return B_; }
  Eigen::Index unknown(std::size_t k) const { return first_[k]; }

  V3<S> acceleration() const {
    V3<S> a = body_.gravity;
    for (const auto& f : force_) a += f * body_.inverse_mass;
    return a;
  }
  V3<S> moment() const {
    V3<S> m = V3<S>::Zero();
    for (std::size_t k = 0; k < force_.size(); ++k) m += contacts_[k].r.cross(force_[k]);
    return m;
  }
  V3<S> spinRate() const { return body_.A * V3<S>(moment() - body_.omega.cross(body_.L)); }
  /// d/dt of the velocity of the body where it is touched; also of a contact that has no force.
  V3<S> slipRate(std::size_t k) const {
    V3<S> d = free_[k];
    for (std::size_t l = 0; l < force_.size(); ++l) d += responseAt(contacts_[k].r, l, force_[l]);
    return d;
  }
  V3<S> slipRateAt(const ContactInstant<S>& c) const {
    return acceleration() + spinRate().cross(c.r) + body_.omega.cross(V3<S>(c.point_rate - body_.v));
  }
  /// d^2(gap)/dt^2.
  S gapAcceleration(const ContactInstant<S>& c) const {
    return c.n.dot(slipRateAt(c)) + c.normal_rate.dot(body_.velocityAt(c.r));
  }
  /// How all forces answer as the direction of slip at contact l turns about its normal, by 1 rad.
  std::vector<V3<S>> answerToTurn(std::size_t l, bool redundant) const {
    const auto& by = contacts_[l];
    const V3<S> own = y_[first_[l]] * V3<S>(-by.friction * by.n.cross(by.slip));
    VectorOf<S> b(b_.size());
    for (std::size_t k = 0; k < contacts_.size(); ++k) {
      const V3<S> d = responseAt(contacts_[k].r, l, own);
      if (contacts_[k].mode == HeldMode::sticks) {
        b.template segment<3>(first_[k]) = d;
      } else {
        b[first_[k]] = contacts_[k].n.dot(d);
      }
    }
    const VectorOf<S> y = solveForces(B_, b, redundant);
    std::vector<V3<S>> answer(contacts_.size());
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      answer[k] = contacts_[k].mode == HeldMode::sticks ? V3<S>(y.template segment<3>(first_[k]))
                                                        : V3<S>(pushOf(contacts_[k]) * y[first_[k]]);
    answer[l] += own;
    return answer;
  }
  /// How the velocity at an arm answers to a force at contact l.
  V3<S> responseAt(const V3<S>& r, std::size_t l, const V3<S>& f) const {
    const V3<S> spin = body_.A * contacts_[l].r.cross(f);
    return f * body_.inverse_mass + spin.cross(r);
  }
  /// The same to forces at all contacts.
  V3<S> responseAt(const V3<S>& r, const std::vector<V3<S>>& forces) const {
    V3<S> sum = V3<S>::Zero();
    for (std::size_t l = 0; l < forces.size(); ++l) sum += responseAt(r, l, forces[l]);
    return sum;
  }

 private:
  static V3<S> pushOf(const ContactInstant<S>& c) { return c.n - c.friction * c.slip; }
  Eigen::Index first(Eigen::Index k) const { return first_[static_cast<std::size_t>(k)]; }

  void fill(Eigen::Index k, Eigen::Index l) {
    const auto &at = contacts_[static_cast<std::size_t>(k)], &by = contacts_[static_cast<std::size_t>(l)];
    if (by.mode == HeldMode::slides) {
      const V3<S> push = pushOf(by), answer = push * body_.inverse_mass + V3<S>(body_.A * by.r.cross(push)).cross(at.r);
      if (at.mode == HeldMode::slides) {
        B_(first(k), first(l)) = at.n.dot(answer);
      } else {
        B_.template block<3, 1>(first(k), first(l)) = answer;
      }
      return;
    }
    M3<S> K = -(skew(at.r) * body_.A * skew(by.r));
    K.diagonal().array() += body_.inverse_mass;
    if (at.mode == HeldMode::slides) {
      B_.template block<1, 3>(first(k), first(l)) = at.n.transpose() * K;
    } else {
      B_.template block<3, 3>(first(k), first(l)) = K;
    }
  }

  const BodyInstant<S>& body_;
  const std::vector<ContactInstant<S>>& contacts_;
  std::vector<Eigen::Index> first_;
  std::vector<V3<S>> free_, force_;
  MatrixOf<S> B_;
  VectorOf<S> b_, y_;
};

}  // namespace carom::adjoint_detail
