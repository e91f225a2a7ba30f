// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/friction_from_zero.hpp"
#include "adjoint/impact/law.hpp"
#include "adjoint/numeric/dual.hpp"

namespace carom::adjoint_detail {

/// What an impact depends on.
template <class S>
struct ImpactInputs {
  struct Body {
    bool kinematic = false;  // adds to u and not to K, and no impulse moves it
    bool stays = false;      // the same of a body at rest, which is held
    S inverse_mass = 0;
    M3<S> R, D;  // principal axes to world, inverse inertia in them
    V3<S> x, v, L;
  };
  struct Contact {
    int a = -1, b = -1;  // of the bodies; -1: one that does not move
    V3<S> point, normal;
    PairCoefficientsOf<S> pair;
    bool kept = false;  // n.u = 0 as an equation
    V3<S> surface = V3<S>::Zero();  // of u: the velocity of a's moving surface less that of b's
    bool surface_moves = false;
  };
  std::vector<Body> bodies;
  std::vector<Contact> contacts;
};

/// Of a body after an impact.
template <class S>
struct Velocities {
  V3<S> v, L;
};
template <class S>
struct ImpactOutcome {
  ImpactSolutionOf<S> solution;
  std::vector<Velocities<S>> after;
};

/// Adjoints of states before, models, contacts (gap, normal of the impulse, point) and coefficients.
template <class S>
struct ImpactBars {
  std::vector<StateDerivativeOf<S>> before;
  std::vector<BodyModelDerivativeOf<S>> model;
  std::vector<Eigen::Matrix<S, 7, 1>> contact;
  std::vector<PairCoefficientsOf<S>> pair;
  std::vector<V3<S>> surface;  // of Contact::surface
};

/// The law that a problem falls under, and its adjoint: laws.hpp, compiled in files of their own.
template <class S>
ImpactSolutionOf<S> solveLaw(const ImpactProblemOf<S>& problem);
template <class S>
ImpactProblemDerivativeOf<S> lawPullback(const ImpactProblemOf<S>& problem, const VectorOf<S>& P_bar);

/// Of several contacts, as friction grows from 0: impact/friction_from_zero.hpp.
FromZero fromZero(const ImpactProblem& problem);

/// An impact and its adjoint in numbers of 32 digits, from numbers to numbers of the given kind. Where masses differ
/// much the velocity that a light body gets is the difference of the large impulses of heavy ones, which has no digits
/// left once these are rounded; so nothing is rounded on the way.
template <class S>
ImpactOutcome<S> doubleDoubleImpact(const ImpactInputs<S>& inputs);
template <class S>
ImpactBars<S> doubleDoubleImpactPullback(const ImpactInputs<S>& inputs, const std::vector<StateDerivativeOf<S>>& after_bar);

/// An impact from states to states with its adjoint, in one kind of number S:
///   u_k = surface_k + sum s (v + omega x r),  K_kl = sum s_k s_l (1/m - [r_k]x A [r_l]x),  A = R D R^T,  omega = A L,
///   v+ = v + sum s P/m,  L+ = L + sum s r x P,  with s = 1 on body a and -1 on b.
template <class S>
class ImpactPass {
 public:
  using Problem = ImpactProblemOf<S>;
  using ProblemBar = ImpactProblemDerivativeOf<S>;
  using Bars = ImpactBars<S>;
  // Adjoints of what stands between the inputs and the problem.
  struct Between {
    std::vector<V3<S>> r;  // of the arms
    // of the bodies
    std::vector<V3<S>> omega;
    std::vector<M3<S>> A;
    std::vector<S> inverse_mass;
  };

  explicit ImpactPass(ImpactInputs<S> inputs) : in_(std::move(inputs)) {
    for (const auto& b : in_.bodies) {
      A_.push_back(b.R * b.D * b.R.transpose());
      omega_.push_back(A_.back() * b.L);
      problem_.driven = problem_.driven || (b.kinematic && !b.stays);
    }
    for (std::size_t k = 0; k < in_.contacts.size(); ++k) {
      const auto& c = in_.contacts[k];
      problem_.normal.push_back(c.normal);
      problem_.pair.push_back(c.pair);
      problem_.driven = problem_.driven || c.surface_moves;
      if (c.kept) problem_.held.resize(in_.contacts.size()), problem_.held[k] = 1;
      for (std::size_t i = 0; i < in_.bodies.size(); ++i) {
        const bool is_a = static_cast<int>(i) == c.a;
        if (is_a || static_cast<int>(i) == c.b) arms_.push_back({k, i, is_a ? 1.0 : -1.0, c.point - in_.bodies[i].x});
      }
    }
    assemble();
  }

  const ImpactInputs<S>& inputs() const { return in_; }
  const Problem& problem() const { return problem_; }
  ImpactSolutionOf<S> solve() const { return solveLaw(problem_); }

  std::vector<Velocities<S>> after(const VectorOf<S>& P) const {
    std::vector<Velocities<S>> out;
    for (const auto& b : in_.bodies) out.push_back({b.v, b.L});
    for (const Arm& arm : arms_) {
      if (in_.bodies[arm.body].kinematic) continue;
      const V3<S> P_k = arm.sign * blockOf(P, arm);
      out[arm.body].v += in_.bodies[arm.body].inverse_mass * P_k;
      out[arm.body].L += arm.r.cross(P_k);
    }
    return out;
  }

  Bars pullback(const VectorOf<S>& P, const std::vector<StateDerivativeOf<S>>& after_bar) const {
    Bars bars = noBars();
    bars.before = after_bar;
    Between between = nothingBetween();
    VectorOf<S> P_bar = VectorOf<S>::Zero(P.size());
    for (std::size_t j = 0; j < arms_.size(); ++j) {
      const Arm& arm = arms_[j];
      const auto& b = in_.bodies[arm.body];
      if (b.kinematic) continue;
      const V3<S> P_k = blockOf(P, arm), &v_bar = after_bar[arm.body].v, &L_bar = after_bar[arm.body].L;
      P_bar.template segment<3>(row(arm)) += arm.sign * V3<S>(b.inverse_mass * v_bar + L_bar.cross(arm.r));
      between.inverse_mass[arm.body] += arm.sign * P_k.dot(v_bar);
      between.r[j] = arm.sign * P_k.cross(L_bar);
    }
    problemPullback(lawPullback(problem_, P_bar), between, bars);
    betweenPullback(between, bars);
    return bars;
  }

  /// From the adjoint of the problem to those of what it is made of.
  void problemPullback(const ProblemBar& bar, Between& between, Bars& bars) const {
    for (std::size_t j = 0; j < arms_.size(); ++j)
      for (std::size_t l = 0; l < arms_.size(); ++l) {
        const Arm &a = arms_[j], &b = arms_[l];
        if (a.body != b.body || in_.bodies[a.body].kinematic) continue;
        const M3<S> Ra = skew(a.r), Rb = skew(b.r), &A = A_[a.body];
        const M3<S> K_bar = a.sign * b.sign * M3<S>(bar.K.template block<3, 3>(row(a), row(b)));
        between.inverse_mass[a.body] += K_bar.trace();
        between.A[a.body] -= Ra * K_bar * Rb;     // <K_bar, -Ra dA Rb>, Ra^T = -Ra
        between.r[j] += unskew(K_bar * Rb * A);  // <K_bar, -[dr]x A Rb>
        between.r[l] += unskew(A * Ra * K_bar);  // <K_bar, -Ra A [dr]x>
      }
    for (std::size_t j = 0; j < arms_.size(); ++j) {
      const Arm& arm = arms_[j];
      const V3<S> u_bar = arm.sign * blockOf(bar.u, arm);
      bars.before[arm.body].v += u_bar;
      between.omega[arm.body] += arm.r.cross(u_bar);
      between.r[j] += u_bar.cross(omega_[arm.body]);
      bars.before[arm.body].x -= between.r[j];
      bars.contact[arm.contact].template tail<3>() += between.r[j];
    }
    for (std::size_t k = 0; k < bars.contact.size(); ++k) {
      bars.contact[k].template segment<3>(1) += bar.normal[k];
      bars.pair[k] += bar.pair[k];
      bars.surface[k] += bar.u.template segment<3>(3 * static_cast<Eigen::Index>(k));
    }
  }
  void betweenPullback(Between& between, Bars& bars) const {
    for (std::size_t i = 0; i < in_.bodies.size(); ++i) {
      const auto& b = in_.bodies[i];
      const M3<S>& A = A_[i];
      M3<S>& A_bar = between.A[i];
      A_bar += between.omega[i] * b.L.transpose();
      bars.before[i].L += A * between.omega[i];
      // dA = [theta]x A - A [theta]x - A R dJ R^T A, A symmetric
      bars.before[i].theta += unskew(A_bar * A - A * A_bar);
      bars.model[i].addInertiaBar(-(b.R.transpose() * A * A_bar * A * b.R));
      bars.model[i].mass -= between.inverse_mass[i] * b.inverse_mass * b.inverse_mass;
    }
  }
  Bars noBars() const {
    const std::size_t bodies = in_.bodies.size(), contacts = in_.contacts.size();
    return {std::vector<StateDerivativeOf<S>>(bodies), std::vector<BodyModelDerivativeOf<S>>(bodies),
            std::vector<Eigen::Matrix<S, 7, 1>>(contacts, Eigen::Matrix<S, 7, 1>::Zero()),
            std::vector<PairCoefficientsOf<S>>(contacts), std::vector<V3<S>>(contacts, V3<S>::Zero())};
  }
  Between nothingBetween() const {
    const std::size_t n = in_.bodies.size();
    return {std::vector<V3<S>>(arms_.size(), V3<S>::Zero()), std::vector<V3<S>>(n, V3<S>::Zero()),
            std::vector<M3<S>>(n, M3<S>::Zero()), std::vector<S>(n, S(0))};
  }

 private:
  // One body at one contact, r from its centre of mass.
  struct Arm {
    std::size_t contact, body;
    double sign;
    V3<S> r;
  };

  static Eigen::Index row(const Arm& arm) { return 3 * static_cast<Eigen::Index>(arm.contact); }
  static V3<S> blockOf(const VectorOf<S>& all, const Arm& arm) { return all.template segment<3>(row(arm)); }

  void assemble() {
    const auto n = static_cast<Eigen::Index>(in_.contacts.size());
    problem_.u.setZero(3 * n);
    problem_.K.setZero(3 * n, 3 * n);
    for (Eigen::Index k = 0; k < n; ++k)
      problem_.u.template segment<3>(3 * k) = in_.contacts[static_cast<std::size_t>(k)].surface;
    for (const Arm& k : arms_)
      problem_.u.template segment<3>(row(k)) += k.sign * V3<S>(in_.bodies[k.body].v + omega_[k.body].cross(k.r));
    for (const Arm& k : arms_)
      for (const Arm& l : arms_) {
        if (k.body != l.body || in_.bodies[k.body].kinematic) continue;
        const M3<S> translation = in_.bodies[k.body].inverse_mass * M3<S>::Identity(),
                    rotation = skew(k.r) * A_[k.body] * skew(l.r);
        problem_.K.template block<3, 3>(row(k), row(l)) += k.sign * l.sign * (translation - rotation);
      }
  }

  ImpactInputs<S> in_;
  std::vector<M3<S>> A_;
  std::vector<V3<S>> omega_;
  std::vector<Arm> arms_;
  Problem problem_;
};

}  // namespace carom::adjoint_detail
