// SPDX-License-Identifier: MIT
#include "adjoint/contact/cone_program.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "adjoint/base/errors.h"
#include "adjoint/contact/cone_terms.hpp"
#include "adjoint/contact/interior_point.hpp"
#include "adjoint/contact/symmetric_inverse.hpp"
#include "adjoint/contact/wedge.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// kSettled: what Newton's steps may leave, once they get no further, of what nearly redundant contacts ask of each
// other. In 32 digits points, which are doubles, are off by so much.
template <class T>
struct ConePrecision;
template <>
struct ConePrecision<double> {
  static constexpr double kRounding = 1e-13, kExact = 2e-15, kSettled = 1e-13;
};
template <>
struct ConePrecision<DoubleDouble> {
  static constexpr double kRounding = 1e-27, kExact = 1e-30, kSettled = 1e-13;
};

// Offsets below this share of velocities have forces in units of their own; less yet is none.
constexpr double kSlight = 1e-2, kNoLoad = 1e-13;
constexpr int kCarefulSteps = 40;
// What two contacts next to one another, one of which bears nothing, may ask of each other at the last, as a share of the speeds:
// their velocities along the normals differ by the distance between them, and one pressure cannot meet both.
constexpr double kNearlyRedundant = 1e-10;

template <class T>
T lengthOf(const V3<T>& v) {
  using std::sqrt;
  return sqrt(v.dot(v));
}
template <class T>
T largestOf(const VectorOf<T>& v) {
  T most = T(0);
  for (Index i = 0; i < v.size(); ++i) most = std::max({most, v[i], T(-v[i])});
  return most;
}

// The program in units that make its numbers alike: f = C f' size, V = C^-1 V' size.
template <class T>
struct Evened {
  ConeProgramOf<T> q;
  std::vector<T> units;
  T size = T(0);

  explicit Evened(const ConeProgramOf<T>& p) : q(p), units(forceUnits<T>(p.K)) {
    const int n = p.contacts();
    for (int k = 0; k < n; ++k) {
      const T c = units[static_cast<std::size_t>(k)];
      q.K.middleRows(3 * k, 3) *= c;
      q.K.middleCols(3 * k, 3) *= c;
      q.b.template segment<3>(3 * k) *= c;
    }
    for (std::size_t e = 0; e < q.equal.size(); ++e) q.rise[e] *= units[static_cast<std::size_t>(q.equal[e])];
    size = largestOf<T>(q.b);
    for (const T& r : q.rise) size = std::max({size, r, T(-r)});
    if (!(size > T(0))) size = T(1);
    q.b /= size;
    for (T& r : q.rise) r /= size;
    for (std::size_t k = 0; k < q.offset.size(); ++k) q.offset[k] /= units[k] * size;
  }
  ConePointOf<T> asWritten(ConePointOf<T> at) const {
    for (std::size_t k = 0; k < units.size(); ++k) {
      at.f[k] *= units[k] * size;
      at.pressure[k] *= units[k] * size;
    }
    for (std::size_t e = 0; e < q.equal.size(); ++e)
      at.lambda[static_cast<Index>(e)] *= units[static_cast<std::size_t>(q.equal[e])] * size;
    return at;
  }
};

// Newton's method on the conditions with their active set, which changes with the point.
template <class T>
class ActiveSet {
 public:
  /// `unit`: of forces, see forceScale.
  ActiveSet(const ConeProgramOf<T>& q, const T& unit) : q_(q), unit_(unit) {}

  // The solution, when found from this point within some steps; `settled` as in ConePrecision.
  std::optional<ConePointOf<T>> from(ConePointOf<T> at, int steps, double settled = ConePrecision<T>::kSettled) const {
    T before = T(0);
    bool kept = false;
    for (int i = 0; i <= steps; ++i) {
      ConeTerms<T> now(q_, std::move(at));
      const T off = largestOf<T>(now.residual), size = T(1) + largestOf<T>(now.f);
      if (!std::isfinite(rounded(off))) return std::nullopt;
      const bool right = i > 0 && holds(now);
      if (right && off <= T(settled) * size &&
          (off <= T(ConePrecision<T>::kExact) * size || (kept && !(off < T(0.1) * before))))
        return finished(now);
      kept = right;
      before = off;
      now.step(VectorOf<T>(-symmetricInverse<T>(now.M, VectorOf<T>::Ones(now.M.rows())) * now.residual));
      at = changed(ConeTerms<T>(q_, now.at));
    }
    return std::nullopt;
  }

  // The same with one change of the set at a time: a step ends where the first pressure would turn negative, and once the
  // set is solved what violates it most is put where it belongs. Where contacts are redundant and all slide nearly alike,
  // their loads are decided by so little that whole steps leave the cones of several at once.
  std::optional<ConePointOf<T>> carefullyFrom(ConePointOf<T> at, int steps) const {
    for (int i = 0; i <= steps; ++i) {
      ConeTerms<T> now(q_, std::move(at));
      const T off = largestOf<T>(now.residual), size = T(1) + largestOf<T>(now.f);
      if (!std::isfinite(rounded(off))) return std::nullopt;
      if (off <= T(ConePrecision<T>::kExact) * size) {  // no less: loads that are all but decided would stay on the way
        const std::optional<std::size_t> k = firstThatFails(now);
        if (!k) return finished(now);
        const auto row = 3 * static_cast<Index>(*k);
        classify(*k, now.f.template segment<3>(row), now.V.template segment<3>(row), now.at);
        if (now.at.state[*k] == ConeState::slides && !(now.at.pressure[*k] > T(0))) return std::nullopt;
        at = std::move(now.at);
        continue;
      }
      const VectorOf<T> step = -symmetricInverse<T>(now.M, VectorOf<T>::Ones(now.M.rows())) * now.residual;
      T share = T(1);
      std::optional<std::size_t> first;
      for (std::size_t k = 0; k < now.at.state.size(); ++k) {
        if (now.at.state[k] != ConeState::slides) continue;
        const T p = now.at.pressure[k], change = step[now.first[k]];
        if (p + share * change < T(0)) share = p > T(0) ? T(-p / change) : T(0), first = k;
      }
      now.step(VectorOf<T>(share * step));
      if (first) now.at.state[*first] = ConeState::apex;
      at = std::move(now.at);
    }
    return std::nullopt;
  }

  // Where friction of every contact is known: all inside, or all on the side against the velocity b.
  ConePointOf<T> guess(bool slides) const {
    const auto n = static_cast<std::size_t>(q_.contacts());
    ConePointOf<T> at{std::vector<ConeState>(n, ConeState::inside), std::vector<V3<T>>(n, V3<T>::Zero()), q_.offset,
                      std::vector<V3<T>>(n, V3<T>::Zero()), VectorOf<T>::Zero(static_cast<Index>(q_.equal.size()))};
    for (std::size_t k = 0; k < n; ++k) {
      if (q_.free[k]) at.state[k] = ConeState::free, at.pressure[k] = T(0);
      if (q_.free[k] || (!slides && q_.friction[k] > T(0))) continue;
      at.state[k] = ConeState::slides;
      at.direction[k] = against(k, q_.b.template segment<3>(3 * static_cast<Index>(k)));
      if (!(at.pressure[k] > T(0))) at.pressure[k] = T(1);
    }
    return at;
  }

  // The active set of forces f with velocities V.
  ConePointOf<T> near(const VectorOf<T>& f, const VectorOf<T>& V, const VectorOf<T>& lambda) const {
    ConePointOf<T> at = guess(false);
    at.lambda = lambda;
    for (std::size_t k = 0; k < at.state.size(); ++k) {
      at.f[k] = f.template segment<3>(3 * static_cast<Index>(k));
      if (q_.free[k]) {
        at.pressure[k] = q_.normal[k].dot(at.f[k]);
      } else {
        at.state[k] = ConeState::inside;
        classify(k, at.f[k], V.template segment<3>(3 * static_cast<Index>(k)), at);
      }
    }
    return at;
  }

 private:
  V3<T> against(std::size_t k, const V3<T>& v) const {
    const V3<T> v_t = v - q_.normal[k].dot(v) * q_.normal[k];
    const T speed = lengthOf<T>(v_t);
    if (speed > T(1e-14)) return -v_t / speed;
    if (!(q_.friction[k] > T(0))) return V3<T>::Zero();
    Index least = 0;
    q_.normal[k].unaryExpr([](const T& x) { return std::abs(rounded(x)); }).minCoeff(&least);
    const V3<T> across = q_.normal[k].cross(V3<T>(V3<T>::Unit(least)));
    return across / lengthOf<T>(across);
  }

  bool holds(const ConeTerms<T>& t, std::size_t k) const {
    const auto row = 3 * static_cast<Index>(k);
    const V3<T> f = t.f.template segment<3>(row), v = t.V.template segment<3>(row), n = q_.normal[k];
    const T mu = q_.friction[k], little = T(ConePrecision<T>::kRounding), P = n.dot(f) + q_.offset[k];
    const T little_v = little * (T(1) + largestOf<T>(t.f));
    switch (t.at.state[k]) {
      case ConeState::free:
        return true;
      case ConeState::apex:
        return n.dot(v) >= mu * lengthOf<T>(v - n.dot(v) * n) - little_v;
      case ConeState::slides:
        // one that is 0 by rounding of the others has either sign
        return t.at.pressure[k] > -little_v && (!(mu > T(0)) || -t.at.direction[k].dot(v) >= -little_v);
      case ConeState::inside:
        break;
    }
    return lengthOf<T>(f - n.dot(f) * n) <= mu * P + little * (T(1) + lengthOf<T>(f));
  }
  bool holds(const ConeTerms<T>& t) const {
    for (std::size_t k = 0; k < t.at.state.size(); ++k)
      if (!holds(t, k)) return false;
    return true;
  }

  std::optional<std::size_t> firstThatFails(const ConeTerms<T>& t) const {
    for (std::size_t k = 0; k < t.at.state.size(); ++k)
      if (!holds(t, k)) return k;
    return std::nullopt;
  }

  // Where f - V, in units that make them alike, put back into the cone, stands in it.
  void classify(std::size_t k, const V3<T>& f, const V3<T>& v, ConePointOf<T>& at) const {
    const V3<T> n = q_.normal[k], w = f / unit_ - v;
    const T mu = q_.friction[k], w_n = n.dot(w) + q_.offset[k] / unit_;
    const V3<T> w_t = w - n.dot(w) * n;
    const T side = lengthOf<T>(w_t), onto = (w_n + mu * side) / (T(1) + mu * mu);
    at.f[k] = f;
    if (mu > T(0) && side <= mu * w_n) {
      at.state[k] = ConeState::inside;
    } else if (mu * side <= -w_n) {
      at.state[k] = ConeState::apex;
    } else {
      at.state[k] = ConeState::slides;
      at.pressure[k] = onto * unit_;
      at.direction[k] = mu > T(0) ? V3<T>(w_t / side) : against(k, v);
    }
  }
  ConePointOf<T> changed(ConeTerms<T> t) const {
    for (std::size_t k = 0; k < t.at.state.size(); ++k) {
      const auto row = 3 * static_cast<Index>(k);
      if (!holds(t, k)) classify(k, t.f.template segment<3>(row), t.V.template segment<3>(row), t.at);
    }
    return std::move(t.at);
  }
  ConePointOf<T> finished(ConeTerms<T>& t) const {
    for (std::size_t k = 0; k < t.at.state.size(); ++k)
      if (t.at.state[k] == ConeState::slides && !(q_.friction[k] > T(0)))
        t.at.direction[k] = against(k, t.V.template segment<3>(3 * static_cast<Index>(k)));
    return std::move(t.at);
  }

  const ConeProgramOf<T>& q_;
  T unit_;
};

// How large forces are where velocities are about 1: what slides fast and is pressed on little bears no more than that.
template <class T>
T forceScale(const ConeProgramOf<T>& q) {
  T most = T(0);
  for (const T& x : q.offset) most = std::max({most, x, T(-x)});
  for (const T& x : q.rise) most = std::max({most, x, T(-x)});
  return most > T(kNoLoad) && most < T(kSlight) ? most : T(1);
}

template <class T>
ConeProgramOf<double> inDoubles(const ConeProgramOf<T>& q) {
  const auto number = [](const T& x) { return rounded(x); };
  ConeProgramOf<double> d{q.K.unaryExpr(number), q.b.unaryExpr(number), {}, {}, {}, q.free, q.equal, {}};
  for (const auto& n : q.normal) d.normal.push_back(n.unaryExpr(number));
  for (const T& x : q.friction) d.friction.push_back(rounded(x));
  for (const T& x : q.offset) d.offset.push_back(rounded(x));
  for (const T& x : q.rise) d.rise.push_back(rounded(x));
  return d;
}

}  // namespace

template <class T>
ConePointOf<T> solveConeProgram(const ConeProgramOf<T>& program) {
  const Evened<T> even(program);
  const T unit = forceScale(even.q);
  const ActiveSet<T> set(even.q, unit);
  for (const bool slides : {false, true})
    if (auto at = set.from(set.guess(slides), slides ? 5 : 2)) return even.asWritten(*at);
  ConeProgramOf<double> in_units = inDoubles<T>(even.q);
  const double scale = rounded(unit);
  in_units.K *= scale;
  for (double& offset : in_units.offset) offset /= scale;
  InteriorPoint point(in_units);
  std::vector<ConePointOf<T>> closest;
  for (int i = 0; i < 60; ++i) {
    point.step();
    if (!std::isfinite(point.gap())) break;
    if (i % 2 == 0 || point.gap() > 1e-5) continue;
    const auto near = set.near(VectorOf<T>(scale * point.forces().template cast<T>()), point.velocities().template cast<T>(),
                               VectorOf<T>(scale * point.multipliers().template cast<T>()));
    if (auto at = set.from(near, 6)) return even.asWritten(*at);
    closest.push_back(near);
  }
  for (const ConePointOf<T>& near : closest)
    if (auto at = set.carefullyFrom(near, kCarefulSteps)) return even.asWritten(*at);
  // a load that is all but decided may come to its place by many steps
  if (auto at = set.from(set.guess(true), kCarefulSteps)) return even.asWritten(*at);
  for (const ConePointOf<T>& near : closest)
    if (auto at = set.from(near, kCarefulSteps, kNearlyRedundant)) return even.asWritten(*at);
  if (wedgedPair(inDoubles<T>(even.q)))
    throw NotComputable("two of its contacts are wedged: their friction carries any force along the line between them, so that their "
                        "impulse is unbounded");
  throw NotComputable("the friction impulses of its contacts, which are many or ill-conditioned, were not found");
}

template ConePointOf<double> solveConeProgram(const ConeProgramOf<double>&);
template ConePointOf<DoubleDouble> solveConeProgram(const ConeProgramOf<DoubleDouble>&);

}  // namespace carom::adjoint_detail
