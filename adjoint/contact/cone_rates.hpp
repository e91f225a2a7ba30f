// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "adjoint/contact/cone_terms.hpp"

/// The solution of a cone program in any number, with the adjoint of it: the active set comes from the values, rates
/// from its conditions, which hold along with them.
namespace carom::adjoint_detail {

template <class S>
inline constexpr bool has_rates = !std::is_same_v<S, Value<S>>;

/// Adjoint of a ConeProgram, field by field.
template <class S>
struct ConeBarOf {
  MatrixOf<S> K;
  VectorOf<S> b;
  std::vector<V3<S>> normal;
  std::vector<S> friction, offset, rise;
};

template <class S>
ConeProgramOf<Value<S>> valuesOf(const ConeProgramOf<S>& q) {
  ConeProgramOf<Value<S>> v{valuesOf(q.K), valuesOf(q.b), {}, {}, {}, q.free, q.equal, {}};
  for (const auto& n : q.normal) v.normal.push_back(valuesOf(n));
  for (const S& x : q.friction) v.friction.push_back(valueOf(x));
  for (const S& x : q.offset) v.offset.push_back(valueOf(x));
  for (const S& x : q.rise) v.rise.push_back(valueOf(x));
  return v;
}

template <class S>
class ConeSolution {
 public:
  using T = Value<S>;

  /// `at`: the solution of the values of the program.
  ConeSolution(ConeProgramOf<S> program, const ConePointOf<T>& at)
      : q_(std::move(program)), terms_(q_, written(q_, at)), inverse_(inverseOf(terms_, spectrum_)) {
    if constexpr (has_rates<S>) {
      for (int pass = 0; pass < 2; ++pass) {  // the second one gives back the digits that a stiff set costs
        VectorOf<S> rates = terms_.residual;
        for (Eigen::Index i = 0; i < rates.size(); ++i) rates[i].value = T(0);
        terms_.step(VectorOf<S>(-inverse_.template cast<S>() * rates));
        terms_ = ConeTerms<S>(q_, terms_.at);
      }
      if (slipsAway()) terms_ = ConeTerms<S>(q_, terms_.at);
    }
  }
  ConeSolution(const ConeSolution&) = delete;
  ConeSolution& operator=(const ConeSolution&) = delete;

  const ConeTerms<S>& terms() const { return terms_; }
  /// Whether redundant contacts lose digits of derivatives: friction that is weak hardly tells how they share their
  /// load.
  bool losesDigits() const { return spectrum_.singular && spectrum_.condition > kCondition; }

  /// f_bar is in the range of K.
  ConeBarOf<S> pullback(const VectorOf<S>& f_bar) const {
    const ConeTerms<S>& t = terms_;
    const Eigen::Index columns = t.J.cols(), equations = t.C.cols();
    VectorOf<S> right = VectorOf<S>::Zero(columns + equations);
    right.head(columns) = t.J.transpose() * f_bar;
    const MatrixOf<S> inverse = inverse_.template cast<S>();
    VectorOf<S> z = -inverse * right;  // the adjoint of the conditions
    z -= inverse * (t.M * z + right);
    VectorOf<S> V_bar = t.J * z.head(columns);
    if constexpr (has_rates<S>) {
      const VectorOf<S> turns = slipBar(z, f_bar + q_.K * V_bar - q_.K * across(z));
      right.head(columns) = t.J.transpose() * (q_.K * turns);
      right.tail(equations) = -t.C.transpose() * turns;
      z -= inverse * right;
      V_bar = t.J * z.head(columns) + turns;
    }
    const std::size_t n = q_.normal.size();
    ConeBarOf<S> bar{MatrixOf<S>::Zero(3 * q_.contacts(), 3 * q_.contacts()),
                     V_bar,
                     std::vector<V3<S>>(n, V3<S>::Zero()),
                     std::vector<S>(n, S(0)),
                     std::vector<S>(n, S(0)),
                     std::vector<S>(q_.equal.size(), S(0))};
    VectorOf<S> forces = t.f;  // f - sum lambda n
    for (Eigen::Index e = 0; e < equations; ++e) {
      const auto k = static_cast<std::size_t>(q_.equal[static_cast<std::size_t>(e)]);
      forces.template segment<3>(3 * q_.equal[static_cast<std::size_t>(e)]) -= t.at.lambda[e] * q_.normal[k];
    }
    const VectorOf<S> Kb = q_.K * bar.b, pulls = across(z);
    bar.K = bar.b * forces.transpose() - pulls * t.f.transpose();
    for (Eigen::Index e = 0; e < equations; ++e) {
      const Eigen::Index row = 3 * q_.equal[static_cast<std::size_t>(e)];
      const auto k = static_cast<std::size_t>(q_.equal[static_cast<std::size_t>(e)]);
      const V3<S> by_lambda = Kb.template segment<3>(row), by_z = t.Kf.template segment<3>(row);
      bar.normal[k] -= t.at.lambda[e] * by_lambda + z[columns + e] * by_z;
      bar.rise[static_cast<std::size_t>(e)] = z[columns + e];
    }
    const VectorOf<S> whole = f_bar + Kb - q_.K * pulls;
    for (int k = 0; k < q_.contacts(); ++k) contactPullback(k, whole.template segment<3>(3 * k), z, bar);
    return bar;
  }

 private:
  static constexpr double kCondition = 1e4;

  // sum z n of the equations
  VectorOf<S> across(const VectorOf<S>& z) const {
    VectorOf<S> sum = VectorOf<S>::Zero(terms_.f.size());
    for (std::size_t e = 0; e < q_.equal.size(); ++e)
      sum.template segment<3>(3 * q_.equal[e]) +=
          z[terms_.J.cols() + static_cast<Eigen::Index>(e)] * q_.normal[static_cast<std::size_t>(q_.equal[e])];
    return sum;
  }

  // Friction that grows from 0 turns with the slip, t = -V_t/|V_t|; its share in the adjoint of V is of the size of mu,
  // and so has rates alone.
  VectorOf<S> slipBar(const VectorOf<S>& z, const VectorOf<S>& f_bar) const {
    VectorOf<S> bar = VectorOf<S>::Zero(f_bar.size());
    for (int k = 0; k < q_.contacts(); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      const V3<S>&n = q_.normal[kk], t = terms_.at.direction[kk];
      if (!isFromZero(k)) continue;
      const V3<S> V = terms_.V.template segment<3>(3 * k);
      const V3<S> t_bar = directionBar(k, z, f_bar.template segment<3>(3 * k));
      bar.template segment<3>(3 * k) = (t_bar - t.dot(t_bar) * t - n.dot(t_bar) * n) / S(t.dot(V));
    }
    return bar;
  }
  bool isFromZero(int k) const {
    const auto kk = static_cast<std::size_t>(k);
    return terms_.at.state[kk] == ConeState::slides && !(q_.friction[kk] > S(0)) &&
           terms_.at.direction[kk].dot(terms_.at.direction[kk]) > S(0);
  }
  V3<S> directionBar(int k, const VectorOf<S>& z, const V3<S>& f_bar) const {
    const auto kk = static_cast<std::size_t>(k);
    const V3<S> V = terms_.V.template segment<3>(3 * k);
    return q_.friction[kk] * (z[terms_.first[kk]] * V + terms_.at.pressure[kk] * f_bar);
  }

  void contactPullback(int k, const V3<S>& f_bar, const VectorOf<S>& z, ConeBarOf<S>& bar) const {
    const auto kk = static_cast<std::size_t>(k);
    const ConeState state = terms_.at.state[kk];
    if (state == ConeState::inside) return;
    const V3<S>&n = q_.normal[kk], t = terms_.at.direction[kk], V = terms_.V.template segment<3>(3 * k);
    const Eigen::Index c = terms_.first[kk];
    const S mu = q_.friction[kk], p = terms_.at.pressure[kk];
    if (state == ConeState::free) {
      bar.normal[kk] += z[c] * V + p * f_bar;
      return;
    }
    bar.offset[kk] -= n.dot(f_bar);
    if (state == ConeState::apex) {
      bar.normal[kk] -= q_.offset[kk] * f_bar;
      return;
    }
    bar.friction[kk] += z[c] * t.dot(V) + p * t.dot(f_bar);
    bar.normal[kk] += z[c] * V + (p - q_.offset[kk]) * f_bar;
    V3<S> t_bar = directionBar(k, z, f_bar);
    if (isFromZero(k)) {
      const S slip = -t.dot(V);
      bar.normal[kk] += (n.dot(V) * (t_bar - t.dot(t_bar) * t) + n.dot(t_bar) * V) / slip;
    }
    if (!(mu > S(0))) return;
    const V3<S> turned_bar = z[c + 1] * V;
    bar.normal[kk] += t.cross(turned_bar);
    t_bar += turned_bar.cross(n);
    bar.normal[kk] -= t_bar.dot(n) * t;  // t stays at right angles to n
  }

  static ConePointOf<S> written(const ConeProgramOf<S>& q, const ConePointOf<T>& at) {
    if constexpr (!has_rates<S>) {
      return at;
    } else {
      using std::sqrt;
      ConePointOf<S> point{at.state, {}, {}, {}, at.lambda.template cast<S>()};
      for (std::size_t k = 0; k < at.state.size(); ++k) {
        point.f.push_back(at.f[k].template cast<S>());
        point.pressure.push_back(S(at.pressure[k]));
        V3<S> t = at.direction[k].template cast<S>();
        t -= V3<S>(q.normal[k] * q.normal[k].dot(t));
        const S square = t.dot(t);
        if (square > S(0)) t /= S(sqrt(square));
        point.direction.push_back(t);
      }
      return point;
    }
  }
  static MatrixOf<T> inverseOf(const ConeTerms<S>& t, Spectrum& spectrum) {
    return symmetricInverse<T>(valuesOf(t.M), unitsOf(t), &spectrum);
  }

  // Friction from 0 on has the direction of the slip, which has rates.
  bool slipsAway() {
    using std::sqrt;
    bool any = false;
    for (int k = 0; k < q_.contacts(); ++k) {
      const auto kk = static_cast<std::size_t>(k);
      V3<S>& t = terms_.at.direction[kk];
      if (!isFromZero(k)) continue;
      const V3<S> v = terms_.V.template segment<3>(3 * k), v_t = v - q_.normal[kk].dot(v) * q_.normal[kk];
      t = -v_t / S(sqrt(S(v_t.dot(v_t))));
      any = true;
    }
    return any;
  }

  ConeProgramOf<S> q_;
  ConeTerms<S> terms_;
  Spectrum spectrum_;
  MatrixOf<T> inverse_;
};

}  // namespace carom::adjoint_detail
