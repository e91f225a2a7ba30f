// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <vector>

#include "adjoint/contact/path_inputs.hpp"
#include "tests/reference/real.h"

namespace carom::reference {

/// A ball or a block on a fixed plane with Coulomb's friction, from the equations of motion alone: the slip u of the
/// contact point, f = N (n - mu u/|u|) while it slides, and while a ball rolls the force along the plane that keeps u
/// 0. Taylor series in time, restarted before anything can grow: as the slip dies, ever shorter ones.
class ContactPath {
 public:
  RVec x, v, spin, gravity, normal;
  RMat R = RMat::identity();
  Real friction, mass, inertia, reach;
  bool slides = true, turns = true;

  ContactPath() = default;
  ContactPath(adjoint_detail::PathForm form, const adjoint_detail::PathInputs<double>& in)
      : x(in.x), v(in.v), gravity(in.gravity), normal(in.normal), friction(in.friction), mass(in.mass),
        inertia(in.J(0, 0)), reach(in.reach) {
    for (int j = 0; j < 3; ++j) R.column[j] = RVec(Vec3(in.R.col(j)));
    momentum = RVec(in.L);
    turns = form != adjoint_detail::PathForm::glide_block;
    slides = adjoint_detail::PathForm::roll_ball != form;
  }
  RVec momentum;  ///< angular, at the start

  /// After the whole time. What slips at the start of rolling is stopped by an impulse at the contact.
  void advance(const Real& time) {
    normal = unit(normal);
    v = v - dot(v, normal) * normal;
    spin = turns ? (1 / inertia) * momentum : RVec();
    if (!slides) {
      const RVec impulse = (-1 / (1 / mass + reach * reach / inertia)) * slip();
      v = v + (1 / mass) * impulse;
      spin = spin - (reach / inertia) * cross(normal, impulse);
    }
    Real left = time;
    while (left > 0) {
      Real step = longest();
      if (left < step) step = left;
      take(step);
      left -= step;
    }
    momentum = turns ? inertia * spin : RVec();
  }
  /// Up to the end of the slip, and how long it takes: by steps down to the last 1e-12 of it, which are a line. (What
  /// is left of the time is as small, and of its derivatives by anything, too.)
  Real slideToEnd() {
    normal = unit(normal);
    v = v - dot(v, normal) * normal;
    spin = turns ? (1 / inertia) * momentum : RVec();
    Real elapsed = 0;
    for (;;) {
      const RVec u = slip();
      const Real size = norm(u), brake = friction * pressure();
      const Real rate = dot(u, slope()) / size - brake * (turns ? 1 + mass * reach * reach / inertia : 1);
      if (!(rate < 0)) throw std::runtime_error("the slip does not end");
      const Real left = -size / rate;
      if (left < Real("1e-12")) {
        const RVec direction = (1 / size) * u;
        x = x + left * v;
        if (turns) R = rotationBy(left * spin) * R;
        v = v + left * (slope() - brake * direction);
        if (turns) spin = spin + (left * brake * mass * reach / inertia) * cross(normal, direction);
        momentum = turns ? inertia * spin : RVec();
        return elapsed + left;
      }
      Real step = longest();
      if (left / 2 < step) step = left / 2;
      take(step);
      elapsed += step;
    }
  }
  RVec slip() const { return turns ? v - reach * cross(spin, normal) : v; }

 private:
  static constexpr int kOrder = 34;

  RVec slope() const { return gravity - dot(gravity, normal) * normal; }
  Real pressure() const { return -dot(gravity, normal); }
  /// How fast the slip can change.
  Real force() const {
    return norm(slope()) + abs(friction * pressure()) * (turns ? 1 + mass * reach * reach / inertia : 1);
  }
  Real longest() const {
    Real step = 10;
    const Real rate = norm(spin) + sqrt(force() / reach);
    if (turns && rate * step > Real(1) / 2) step = 1 / (2 * rate);
    if (slides && force() * step > norm(slip()) / 5) step = norm(slip()) / (5 * force());
    return step;
  }

  void take(const Real& h) {
    std::vector<RVec> u(kOrder + 1), direction(kOrder + 1), velocity(kOrder + 1), w(kOrder + 1);
    std::vector<Real> length(kOrder + 1);
    std::vector<std::array<Real, 4>> q(kOrder + 1);
    velocity[0] = v, w[0] = spin, q[0] = {1, 0, 0, 0};
    RVec moved = h * v;
    Real power = h;
    RVec v_end = v, w_end = spin;
    std::array<Real, 4> q_end = q[0];
    for (int k = 0; k < kOrder; ++k) {
      u[k] = turns ? velocity[k] - reach * cross(w[k], normal) : velocity[k];
      RVec push = k == 0 ? slope() : RVec(), moment;  // accelerations
      if (slides) {
        addFriction(k, u, direction, length, push, moment);
      } else if (k == 0) {
        const RVec f = (-1 / (1 / mass + reach * reach / inertia)) * slope();
        push = push + (1 / mass) * f;
        moment = (-reach / inertia) * cross(normal, f);
      }
      velocity[k + 1] = (Real(1) / (k + 1)) * push;
      w[k + 1] = (Real(1) / (k + 1)) * moment;
      q[k + 1] = turnRate(k, w, q);
      v_end = v_end + power * velocity[k + 1];
      w_end = w_end + power * w[k + 1];
      for (int i = 0; i < 4; ++i) q_end[i] += power * q[k + 1][i];
      power *= h;
      moved = moved + (power / (k + 2)) * velocity[k + 1];
    }
    x = x + moved, v = v_end, spin = w_end;
    if (turns) R = rotationOf(q_end) * R;
  }

  // u/|u| from |u|^2 = u.u and |u| direction = u.
  void addFriction(int k, const std::vector<RVec>& u, std::vector<RVec>& direction, std::vector<Real>& length,
                   RVec& push, RVec& moment) const {
    Real square = 0;
    for (int i = 0; i <= k; ++i) square += dot(u[i], u[k - i]);
    if (k == 0) {
      length[0] = sqrt(square);
    } else {
      for (int i = 1; i < k; ++i) square -= length[i] * length[k - i];
      length[k] = square / (2 * length[0]);
    }
    RVec rest = u[k];
    for (int i = 1; i <= k; ++i) rest = rest - length[i] * direction[k - i];
    direction[k] = (1 / length[0]) * rest;
    const RVec f = (-friction * mass * pressure()) * direction[k];
    push = push + (1 / mass) * f;
    if (turns) moment = (-reach / inertia) * cross(normal, f);
  }

  static std::array<Real, 4> turnRate(int k, const std::vector<RVec>& w, const std::vector<std::array<Real, 4>>& q) {
    std::array<Real, 4> sum{};
    for (int i = 0; i <= k; ++i) {
      const std::array<Real, 4>& p = q[k - i];
      const RVec imaginary{p[1], p[2], p[3]}, turned = p[0] * w[i] + cross(w[i], imaginary);
      sum[0] -= dot(w[i], imaginary);
      for (int j = 0; j < 3; ++j) sum[j + 1] += turned[j];
    }
    for (Real& number : sum) number /= 2 * (k + 1);
    return sum;
  }
  static RMat rotationOf(const std::array<Real, 4>& q) {
    const RVec imaginary{q[1], q[2], q[3]};
    const Real f = 2 / (q[0] * q[0] + dot(imaginary, imaginary));
    RMat m;
    for (int j = 0; j < 3; ++j) {
      const RVec e = axisVector(j), t = cross(imaginary, e);
      m.column[j] = e + (f * q[0]) * t + f * cross(imaginary, t);
    }
    return m;
  }
};

}  // namespace carom::reference
