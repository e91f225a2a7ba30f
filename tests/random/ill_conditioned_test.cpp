// SPDX-License-Identifier: MIT
// Impacts of bodies whose masses and moments differ by up to 1e12, on their own: random ones are held to the conditions
// of equation 4.4, and without friction to a solution in 50 digits.

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "adjoint/base/errors.h"
#include "adjoint/impact/impact.hpp"
#include "adjoint/scene/body_model.h"
#include "tests/support/scenes.h"

namespace carom {

using namespace adjoint_detail;

namespace {

using namespace test;
using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using ExactVector = std::vector<Exact>;
using Exact3 = std::array<Exact, 3>;

constexpr int kImpacts = 4000;
constexpr double kRight = 1e-9;

struct RandomImpact {
  std::vector<BodyModel> models;
  Event event;
  bool friction = false;

  explicit RandomImpact(std::uint64_t seed) {
    Random random(seed);
    const int bodies = 1 + random.below(4), contacts = std::max(1, bodies - 1) + random.below(3);
    const double span = random.below(3) == 0 ? 6 : random.in(0, 6);  // decades either way
    friction = random.below(2) == 0;
    const auto coefficient = [&](std::initializer_list<double> list) {
      return *(list.begin() + random.below(static_cast<int>(list.size())));
    };
    const double e = coefficient({0, 1e-9, 0.3, 0.7, 1 - 1e-9, 1});
    for (int b = 0; b < bodies; ++b) {
      const double inertia = std::pow(10, random.in(-span, span));
      Body body = makeBox("box", {1, 1, 1}, Vec3::Zero());
      body.mass = std::pow(10, random.in(-span, span));
      body.inertia = Inertia::fromMoments(*body.mass * inertia * Vec3(random.in(0.5, 1), random.in(0.5, 1), random.in(0.5, 1)));
      models.push_back(modelOf(body));
      Participant p;
      p.body = b;
      p.impact = 1;
      p.before.x = random.vec(0.1);
      p.before.q = random.rotation();
      p.before.v = random.vec(1);
      const Mat3 R = p.before.q.toRotationMatrix();
      p.before.L = R * (models.back().inertia.asDiagonal() * random.vec(1));
      event.participants.push_back(p);
    }
    for (int k = 0; k < contacts; ++k) {
      Contact& c = event.contacts.emplace_back();
      const bool chain = k + 1 < bodies;  // each body has a contact
      c.a = chain ? k : random.below(bodies);
      c.b = chain ? k + 1 : (c.a + 1 + random.below(bodies)) % (bodies + 1);  // `bodies`: the world
      c.at.gap = 0;
      c.at.point = random.vec(1);
      c.at.normal = random.unit();
      if (c.at.normal.dot(velocityAt(c, nullptr)) > 0) c.at.normal = -c.at.normal;
      c.impulse_normal = c.at.normal;
      c.pair = {random.below(3) == 0 ? random.in(0, 1) : e, friction ? coefficient({0, 1e-9, 0.1, 0.5, 1, 10}) : 0,
                coefficient({-1, 0, 0.5, 1})};
    }
  }

  Vec3 velocityAt(const Contact& c, const std::vector<State>* after) const {
    Vec3 u = Vec3::Zero();
    for (int body : {c.a, c.b}) {
      if (body >= static_cast<int>(models.size())) continue;
      const auto b = static_cast<std::size_t>(body);
      const State& s = after ? (*after)[b] : event.participants[b].before;
      const Vec3 w = models[b].inverseInertiaWorld(s.q.toRotationMatrix()) * s.L;
      u += (body == c.a ? 1.0 : -1.0) * (s.v + w.cross(c.at.point - s.x));
    }
    return u;
  }
  double energy(const std::vector<State>& states) const {
    double sum = 0;
    for (std::size_t b = 0; b < models.size(); ++b) sum += kineticEnergy(models[b], states[b]);
    return sum;
  }
};

// y with A y = b, by elimination with pivots; false where A has no inverse to speak of.
bool eliminate(std::vector<ExactVector> A, ExactVector& y) {
  using boost::multiprecision::abs;
  const std::size_t n = y.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (abs(A[r][c]) > abs(A[pivot][c])) pivot = r;
    if (!(abs(A[pivot][c]) > Exact(1e-35))) return false;
    std::swap(A[c], A[pivot]), std::swap(y[c], y[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const Exact f = A[r][c] / A[c][c];
      for (std::size_t j = c; j < n; ++j) A[r][j] -= f * A[c][j];
      y[r] -= f * y[c];
    }
  }
  for (std::size_t c = 0; c < n; ++c) y[c] /= A[c][c];
  return true;
}

Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact dot(const Exact3& a, const Exact3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact3 exact(const Vec3& v) { return {v[0], v[1], v[2]}; }

// Velocities and angular velocities that impulses along the normals of the contacts `active` give; in 50 digits.
struct ExactImpact {
  const RandomImpact& r;
  std::vector<std::size_t> active;
  std::vector<std::array<Exact3, 3>> A;  // world inverse inertia, rows
  std::vector<Exact3> v, w;              // after it
  bool solved = false;

  ExactImpact(const RandomImpact& impact, std::vector<std::size_t> contacts) : r(impact), active(std::move(contacts)) {
    for (std::size_t b = 0; b < r.models.size(); ++b) {
      const State& s = r.event.participants[b].before;
      const Mat3 R = s.q.toRotationMatrix();
      std::array<Exact3, 3> rows;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          Exact sum = 0;
          for (int k = 0; k < 3; ++k) sum += Exact(R(i, k)) * Exact(r.models[b].inverse_inertia[k]) * Exact(R(j, k));
          rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = sum;
        }
      A.push_back(rows);
      v.push_back(exact(s.v));
      w.push_back(turned(b, exact(s.L)));
    }
    const std::size_t n = active.size();
    std::vector<ExactVector> K(n, ExactVector(n));
    ExactVector P(n), scale(n);
    for (std::size_t j = 0; j < n; ++j) {
      const std::vector<Exact3> v0 = v, w0 = w;
      P[j] = -(1 + Exact(contact(j).pair.elasticity)) * approach(j);
      push(j, 1);
      const std::vector<Exact3> v1 = v, w1 = w;
      v = v0, w = w0;
      for (std::size_t i = 0; i < n; ++i) {
        const Exact before = approach(i);
        v = v1, w = w1;
        K[i][j] = approach(i) - before;
        v = v0, w = w0;
      }
    }
    for (std::size_t i = 0; i < n; ++i) scale[i] = sqrt(K[i][i]);
    for (std::size_t i = 0; i < n; ++i) {
      P[i] /= scale[i];
      for (std::size_t j = 0; j < n; ++j) K[i][j] /= scale[i] * scale[j];
    }
    solved = eliminate(K, P);
    for (std::size_t j = 0; solved && j < n; ++j) push(j, P[j] / scale[j]);
  }

  const Contact& contact(std::size_t j) const { return r.event.contacts[active[j]]; }
  Exact3 turned(std::size_t b, const Exact3& L) const { return {dot(A[b][0], L), dot(A[b][1], L), dot(A[b][2], L)}; }
  Exact3 arm(std::size_t j, std::size_t b) const {
    Exact3 to;
    for (int i = 0; i < 3; ++i)
      to[static_cast<std::size_t>(i)] = Exact(contact(j).at.point[i]) - Exact(r.event.participants[b].before.x[i]);
    return to;
  }
  template <class Visit>
  void eachBody(std::size_t j, const Visit& visit) const {
    for (int body : {contact(j).a, contact(j).b})
      if (body < static_cast<int>(r.models.size())) visit(static_cast<std::size_t>(body), body == contact(j).a ? 1 : -1);
  }
  Exact approach(std::size_t j) const {
    Exact sum = 0;
    const Exact3 n = exact(contact(j).at.normal);
    eachBody(j, [&](std::size_t b, int sign) { sum += sign * (dot(n, v[b]) + dot(n, cross(w[b], arm(j, b)))); });
    return sum;
  }
  void push(std::size_t j, const Exact& P) {
    const Exact3 n = exact(contact(j).at.normal);
    eachBody(j, [&](std::size_t b, int sign) {
      const Exact3 dw = turned(b, cross(arm(j, b), n));
      for (std::size_t i = 0; i < 3; ++i) {
        v[b][i] += sign * P * n[i] / Exact(r.models[b].mass);
        w[b][i] += sign * P * dw[i];
      }
    });
  }
};

void expectSame(const Vec3& found, const Exact3& right, double size, const std::string& what) {
  for (int i = 0; i < 3; ++i) {
    const double error = std::abs(static_cast<double>(Exact(found[i]) - right[static_cast<std::size_t>(i)]));
    EXPECT_TRUE(error <= kRight * size) << what << " " << i << ": off by " << error << " of " << size;
  }
}

TEST(IllConditioned, RandomImpactsMeetTheirConditionsOrSayWhy) {
  int solved = 0, refused = 0, compared = 0, joint = 0;
  for (std::uint64_t seed = 1; seed <= kImpacts; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomImpact r(seed);
    std::vector<State> after, before;
    for (const Participant& p : r.event.participants) before.push_back(p.before);
    try {
      solveImpact(r.event, r.models, after);
    } catch (const NotComputable& error) {
      EXPECT_NE(std::string(error.what()), "");
      std::printf("seed %d: %s\n", static_cast<int>(seed), error.what());
      ++refused;
      continue;
    }
    ++solved;
    joint += r.event.contacts.size() > 1;
    EXPECT_TRUE(r.energy(after) <= r.energy(before) * (1 + 1e-9)) << r.energy(after) / r.energy(before) - 1;
    std::vector<std::size_t> active;
    double fastest = 0, largest = 0;
    for (const Contact& c : r.event.contacts) largest = std::max(largest, c.impulse.norm());
    for (const Contact& c : r.event.contacts)
      fastest = std::max({fastest, r.velocityAt(c, nullptr).norm(), r.velocityAt(c, &after).norm()});
    Vec3 momentum = Vec3::Zero();
    double total = 0;
    for (std::size_t b = 0; b < r.models.size(); ++b) {
      momentum += r.models[b].mass * (after[b].v - before[b].v);
      total += r.models[b].mass * (after[b].v.norm() + before[b].v.norm());
    }
    for (std::size_t k = 0; k < r.event.contacts.size(); ++k) {
      const Contact& c = r.event.contacts[k];
      const double u = c.at.normal.dot(r.velocityAt(c, nullptr)), v = c.at.normal.dot(r.velocityAt(c, &after));
      EXPECT_TRUE(v >= -c.pair.elasticity * u - kRight * fastest) << "contact " << k << " parts at " << v << " after " << u;
      const double P_n = c.at.normal.dot(c.impulse), P_t = (c.impulse - P_n * c.at.normal).norm();
      EXPECT_TRUE(P_n >= -1e-12 * largest) << "contact " << k << " pulls";
      EXPECT_TRUE(P_t <= c.pair.friction * P_n + 1e-9 * P_n + 1e-12 * largest) << "contact " << k << ": " << P_t << " of " << P_n;
      if (P_n > 0) active.push_back(k);
      if (c.b >= static_cast<int>(r.models.size())) momentum -= c.impulse, total += c.impulse.norm();
    }
    EXPECT_TRUE(momentum.norm() <= 1e-12 * total) << momentum.norm() / total;
    if (r.friction) continue;
    const ExactImpact right(r, active);
    if (!right.solved) continue;
    ++compared;
    for (std::size_t b = 0; b < r.models.size(); ++b) {
      const std::string name = "body " + std::to_string(b);
      expectSame(after[b].v, right.v[b], fastest + after[b].v.norm(), name + " velocity");
      const Vec3 w = r.models[b].inverseInertiaWorld(after[b].q.toRotationMatrix()) * after[b].L;
      expectSame(w, right.w[b], fastest + w.norm(), name + " spin");
    }
  }
  std::printf("%d impacts: %d solved (%d joint), %d compared in 50 digits, %d refused\n", kImpacts, solved, joint, compared,
              refused);
  EXPECT_GT(compared, kImpacts / 4);
  EXPECT_LE(refused, kImpacts / 100);
}

}  // namespace
}  // namespace carom
