// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/joint_law.hpp"
#include "adjoint/impact/single_laws.hpp"
#include "adjoint/motion/motion.h"

namespace carom::detail {

/// An impact from states to states with its adjoint, in one kind of number S: what ImpactAssembly and DualEvent do, for
/// bodies whose masses differ too much for doubles. There the velocity that a light body gets is the difference of the
/// large impulses of heavy ones, which has no digits left once these are rounded; so nothing is, from states to states.
template <class S>
struct ImpactPass {
  struct Body {
    bool kinematic = false;
    S inverse_mass = 0;
    M3<S> A = M3<S>::Zero();  // world inverse inertia
    V3<S> v = V3<S>::Zero(), L = V3<S>::Zero();
  };
  // One body at one contact, s = 1 on body a and -1 on b, r from the centre of mass.
  struct Arm {
    std::size_t contact, body;
    double sign;
    V3<S> r;
  };
  struct Pair {
    S elasticity = 0, friction = 0, tangential_elasticity = 0;
  };
  // With the fields of ImpactProblem; as a Bar with those of ImpactProblemDerivative.
  struct Problem {
    MatrixOf<S> K;
    VectorOf<S> u;
    std::vector<V3<S>> normal;
    std::vector<Pair> pair;
    bool driven = false;
  };
  // Adjoint of a Body, and of one contact.
  struct BodyBar {
    S inverse_mass = 0;
    M3<S> A = M3<S>::Zero();
    V3<S> x = V3<S>::Zero(), v = V3<S>::Zero(), L = V3<S>::Zero();
  };
  struct ContactBar {
    V3<S> normal = V3<S>::Zero(), point = V3<S>::Zero();
    Pair pair;
  };
  struct OneContact {
    M3<S> K;
    V3<S> u, normal;
    Pair pair;
  };

  std::vector<Body> bodies;
  std::vector<Arm> arms;
  Problem problem;
  VectorOf<S> P;
  ImpactMode mode = ImpactMode::joint;
  double margin = 1;

  /// From bodies, arms, normals and pairs: the velocities u, the matrix K and the impulses.
  void solve() {
    const auto n = static_cast<Index>(problem.normal.size());
    problem.u = VectorOf<S>::Zero(3 * n);
    problem.K = MatrixOf<S>::Zero(3 * n, 3 * n);
    for (const Body& b : bodies) problem.driven = problem.driven || b.kinematic;
    for (const Arm& k : arms) problem.u.template segment<3>(row(k)) += S(k.sign) * velocityAt(k);
    for (const Arm& k : arms)
      for (const Arm& l : arms) {
        const Body& b = bodies[k.body];
        if (k.body != l.body || b.kinematic) continue;
        const M3<S> translation = b.inverse_mass * M3<S>::Identity(), rotation = skewOf<S>(k.r) * b.A * skewOf<S>(l.r);
        problem.K.template block<3, 3>(row(k), row(l)) += S(k.sign * l.sign) * (translation - rotation);
      }
    if (n > 1) {
      const Branch<S> b(problem);
      P = b.P_N + b.kappa * b.d;
      margin = b.limit < 0 ? b.margin : 1.0;
      return;
    }
    if (only().pair.friction > 0) {
      const FrictionTerms<S> t(only());
      P = t.impulse();
      mode = t.slides ? ImpactMode::slide : ImpactMode::stick;
      margin = t.margin;
    } else {
      P = FrictionlessTerms<S>(only()).impulse();
      mode = ImpactMode::frictionless;
    }
  }

  /// Velocities and angular momenta after it.
  std::vector<Body> after() const {
    std::vector<Body> out = bodies;
    for (const Arm& arm : arms) {
      Body& b = out[arm.body];
      if (b.kinematic) continue;
      const V3<S> P_k = S(arm.sign) * V3<S>(P.template segment<3>(row(arm)));
      b.v += b.inverse_mass * P_k;
      b.L += arm.r.cross(P_k);
    }
    return out;
  }

  /// `bodies_bar` holds the adjoints of v and L after the impact, and gets those of everything before it.
  void pullback(std::vector<BodyBar>& bodies_bar, std::vector<ContactBar>& contacts_bar) const {
    std::vector<V3<S>> r_bar(arms.size(), V3<S>::Zero());
    VectorOf<S> P_bar = VectorOf<S>::Zero(P.size());
    for (std::size_t j = 0; j < arms.size(); ++j) {
      const Arm& arm = arms[j];
      const Body& b = bodies[arm.body];
      if (b.kinematic) continue;
      BodyBar& bar = bodies_bar[arm.body];
      const V3<S> P_k = S(arm.sign) * V3<S>(P.template segment<3>(row(arm)));
      P_bar.template segment<3>(row(arm)) += S(arm.sign) * V3<S>(b.inverse_mass * bar.v + bar.L.cross(arm.r));
      bar.inverse_mass += P_k.dot(bar.v);
      r_bar[j] = P_k.cross(bar.L);
    }
    const Problem bar = lawPullback(P_bar);
    std::vector<V3<S>> omega_bar(bodies.size(), V3<S>::Zero());
    for (std::size_t j = 0; j < arms.size(); ++j)
      for (std::size_t l = 0; l < arms.size(); ++l) {
        const Arm &a = arms[j], &b = arms[l];
        if (a.body != b.body || bodies[a.body].kinematic) continue;
        const M3<S> Ra = skewOf<S>(a.r), Rb = skewOf<S>(b.r), &A = bodies[a.body].A;
        const M3<S> K_bar = S(a.sign * b.sign) * M3<S>(bar.K.template block<3, 3>(row(a), row(b)));
        bodies_bar[a.body].inverse_mass += K_bar.trace();
        bodies_bar[a.body].A -= Ra * K_bar * Rb;          // <K_bar, -Ra dA Rb>, Ra^T = -Ra
        r_bar[j] += unskewOf<S>(M3<S>(K_bar * Rb * A));  // <K_bar, -[dr]x A Rb>
        r_bar[l] += unskewOf<S>(M3<S>(A * Ra * K_bar));  // <K_bar, -Ra A [dr]x>
      }
    for (std::size_t j = 0; j < arms.size(); ++j) {
      const Arm& arm = arms[j];
      const V3<S> u_bar = S(arm.sign) * V3<S>(bar.u.template segment<3>(row(arm)));
      bodies_bar[arm.body].v += u_bar;
      omega_bar[arm.body] += arm.r.cross(u_bar);
      r_bar[j] += u_bar.cross(V3<S>(bodies[arm.body].A * bodies[arm.body].L));
      bodies_bar[arm.body].x -= r_bar[j];
      contacts_bar[arm.contact].point += r_bar[j];
    }
    for (std::size_t k = 0; k < contacts_bar.size(); ++k) {
      contacts_bar[k].normal += bar.normal[k];
      contacts_bar[k].pair = bar.pair[k];
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies_bar[i].A += omega_bar[i] * bodies[i].L.transpose();
      bodies_bar[i].L += bodies[i].A * omega_bar[i];
    }
  }

  /// Of the adjoint of A: that of a turn theta, from dA = [theta]x A - A [theta]x, and that of the inertia tensor in
  /// the axes R, from dA = -A R dJ R^T A.
  V3<S> turnBar(std::size_t body, const BodyBar& bar) const {
    const M3<S>& A = bodies[body].A;
    return unskewOf<S>(M3<S>(bar.A * A - A * bar.A));
  }
  M3<S> inertiaBar(std::size_t body, const BodyBar& bar, const M3<S>& R) const {
    const M3<S> AR = bodies[body].A * R;
    return -(AR.transpose() * bar.A * AR);
  }

 private:
  static Index row(const Arm& arm) { return 3 * static_cast<Index>(arm.contact); }
  V3<S> velocityAt(const Arm& arm) const {
    const Body& b = bodies[arm.body];
    return b.v + V3<S>(b.A * b.L).cross(arm.r);
  }
  OneContact only() const { return {problem.K, problem.u, problem.normal[0], problem.pair[0]}; }

  Problem lawPullback(const VectorOf<S>& P_bar) const {
    const std::size_t n = problem.normal.size();
    Problem bar{MatrixOf<S>::Zero(P_bar.size(), P_bar.size()), VectorOf<S>::Zero(P_bar.size()),
                std::vector<V3<S>>(n, V3<S>::Zero()), std::vector<Pair>(n), false};
    if (n > 1)
      jointPullback<S>(problem, P_bar, bar);
    else if (only().pair.friction > 0)
      FrictionTerms<S>(only()).pullback(V3<S>(P_bar), bar);
    else
      FrictionlessTerms<S>(only()).pullback(V3<S>(P_bar), bar);
    return bar;
  }
};

}  // namespace carom::detail
